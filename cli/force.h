/* --force: a force that a shared library brings. */
#ifndef HOOKE_CLI_FORCE_H
#define HOOKE_CLI_FORCE_H

#include "arguments.h"

enum { HOOKE_DIGEST_SIZE = 65 };

struct cli_force {
  void *library; /* NULL: none */
  hooke_force *function;
  char *file;
  const char *name;
  char digest[HOOKE_DIGEST_SIZE]; /* SHA-256 of the file, hexadecimal */
};

/* Loads what --force names, if it was given, and sets it as the force of the open system, which it has to
 * outlive. A file that is not there, another version or a missing symbol is reported, and the exit code
 * returned. The caller closes it in either case. */
int cli_force_open(const struct cli_arguments *arguments, hooke_system *system, struct cli_force *force);
void cli_force_close(struct cli_force *force);

/* 1 if the force has ended some work; and what has, if work was stopped: that, or "interrupted". */
int32_t cli_force_failed(void);
const char *cli_force_stop(void);

#endif
