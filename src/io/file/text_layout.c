/* Readable layout of JSON: short objects and arrays on one line, long ones with one element a line. */
#include "io/file/text.h"

enum { LINE = 100, INDENT = 2 };

/* The comma after the value, or the key and its value, that begins at `at`, or the end. */
static const char *past_value(const char *at, const char *end) {
  int64_t depth = 0;
  for (; at < end && (*at != ',' || depth > 0); at++) {
    depth += (*at == '{' || *at == '[') - (*at == '}' || *at == ']');
    if (*at != '"') continue;
    for (at++; *at != '"'; at++)
      at += *at == '\\';
  }
  return at;
}

static void new_line(struct hk_text *laid, int32_t depth) {
  hk_text_say(laid, "\n");
  for (int32_t k = 0; k < depth * INDENT; k++)
    hk_text_say(laid, " ");
}

/* Copies it on one line, with a space after every comma and colon outside strings. */
static void add_line(struct hk_text *laid, const char *at, const char *end) {
  int32_t quoted = 0;
  for (; at < end; at++) {
    if (*at == '\\') {
      hk_text_add(laid, at++, 1);
    } else if (*at == '"') {
      quoted = !quoted;
    }
    hk_text_add(laid, at, 1);
    if (!quoted && (*at == ',' || *at == ':')) hk_text_say(laid, " ");
  }
}

static void lay_out(struct hk_text *laid, const char *at, const char *end, int32_t depth) {
  if ((*at != '{' && *at != '[') || end - at <= LINE - depth * INDENT) {
    add_line(laid, at, end);
    return;
  }
  hk_text_add(laid, at++, 1);
  while (at < end - 1) {
    const char *stop = past_value(at, end - 1);
    new_line(laid, depth + 1);
    if (*at == '"' && end[-1] == '}') { /* the key, then its value */
      const char *colon = at + 1;
      while (*colon != '"')
        colon += 1 + (*colon == '\\');
      add_line(laid, at, colon + 2);
      at = colon + 2;
    }
    lay_out(laid, at, stop, depth + 1);
    if (stop < end - 1) hk_text_say(laid, ",");
    at = stop + 1;
  }
  new_line(laid, depth);
  hk_text_add(laid, end - 1, 1);
}

void hk_text_lay_out(const struct hk_text *json, struct hk_text *laid) {
  if (json->status != HOOKE_OK || json->length == 0) {
    laid->status = json->status;
    return;
  }
  lay_out(laid, json->bytes, json->bytes + json->length, 0);
  hk_text_say(laid, "\n");
}
