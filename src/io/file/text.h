/* Text that grows, and JSON in it. */
#ifndef HOOKE_IO_FILE_TEXT_H
#define HOOKE_IO_FILE_TEXT_H

#include "hooke/base.h"

/* Starts as zeros. A failure stays in `status`, and what comes after it is left out. */
struct hooke_text {
  char *bytes; /* not terminated */
  int64_t length, capacity;
  int32_t status;
};

void hooke_text_add(struct hooke_text *text, const char *bytes, int64_t length);
void hooke_text_release(struct hooke_text *text);

/* JSON: `key` is NULL in an array. What is not finite becomes null, and so does a text that is NULL. A text may stand
 * inside a <script> element, whatever it says. */
void hooke_text_open(struct hooke_text *text, const char *key, char bracket);
void hooke_text_close(struct hooke_text *text, char bracket);
void hooke_text_number(struct hooke_text *text, const char *key, double value);
void hooke_text_word(struct hooke_text *text, const char *key, const char *word);
void hooke_text_flag(struct hooke_text *text, const char *key, int32_t flag);

/* Adds to `laid` what `json` holds, one whole value, in lines for people. */
void hooke_text_lay_out(const struct hooke_text *json, struct hooke_text *laid);

#endif
