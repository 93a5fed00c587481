/* What systems do differently for the program: os_posix.c is for POSIX, os_windows.c for Windows. */
#pragma once

#include <stddef.h>
#include <stdint.h>

/* Before anything else: failed writes do not end the process, bytes of standard streams are not translated,
 * and terminals take UTF-8. */
void cli_os_begin(void);

/* From here on a request to end the program (SIGINT, SIGTERM, SIGHUP; Ctrl-C on Windows) calls `interrupt`,
 * which may do no more than a handler of signals. One that the program was told to ignore stays ignored. */
void cli_os_catch_interrupts(void (*interrupt)(int number));

/* Processors of the machine, at least 1. */
int32_t cli_os_processors(void);

/* Memory of this process [bytes], now and at most so far; unchanged where the system does not tell. */
void cli_os_memory(int64_t *now, int64_t *most);

/* Returns free memory to the system. */
void cli_os_give_back_memory(void);

/* Loads a shared library, which stays, and finds two symbols (NULL: it has none). Returns NULL or what is
 * wrong: "" where there is no loader. */
const char *cli_os_load(const char *path, const char *const name[2], void *symbol[2]);

/* ---- files ---- */

/* The last slash of a path; NULL if it has none. */
const char *cli_os_last_slash(const char *path);

/* Names in a folder one by one, NULL after the last; a folder that is not NULL begins again. */
const char *cli_os_next_file(const char *folder);

/* 1 if both paths are of one file. */
int32_t cli_os_is_same_file(const char *one, const char *other);

/* 1 if there is something under this path that is no regular file. */
int32_t cli_os_is_other_than_file(const char *path);

/* Creates an empty file for this user alone, under a name that nobody had and nobody guesses: the six X at
 * the end of `path` become other letters. Returns 0, or -1 with errno. */
int cli_os_make_file(char *path);

/* Opens a page in the reader's browser, which stays when the program ends. Returns 0 if there is none. */
int32_t cli_os_show_page(const char *page);
