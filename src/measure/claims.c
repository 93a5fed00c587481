#include "measure/claims.h"

#include "core/memory.h"
#include "core/print.h"

#include <stdio.h>

/* ---- the table ---- */

static const char *of_name(const struct hk_claims *claims, int64_t row) {
  static const char *const names[] = {"whole", "part", "unknown"};
  return names[claims->claim[row].of];
}

HOOKE_READER(const char *, of, struct hk_claims, of_name(it, row))

const struct hk_table hk_claims_table = {
    .name = "claims",
    .doc = "what the results say, in sentences, the most important first",
    HOOKE_TABLE_ROWS(struct hk_claims, claim, count),
    HOOKE_TABLE_COLUMNS(
        HOOKE_COLUMN(struct hk_claim, key, TEXT, "", "what it is about; it stays where the text changes"),
        HOOKE_COLUMN(struct hk_claim, text, TEXT, "", "the sentence"),
        HOOKE_COLUMN_BY(of, TEXT, "",
                        "whole: it holds for the whole run; part: for a part of it, which the text names; "
                        "unknown: that something is not known"),
        HOOKE_COLUMN(struct hk_claim, by, TEXT, "", "what it rests on"))};

/* ---- filling it ---- */

/* The text of a claim; NULL without memory. */
static char *compose(const char *format, va_list args) {
  va_list again;
  va_copy(again, args);
  const int length = hk_print_list(NULL, 0, format, again);
  va_end(again);
  char *text = hk_new(length + 1, 1);
  if (text) hk_print_list(text, (size_t)length + 1, format, args);
  return text;
}

void hk_claim(struct hk_claims *claims, const char *key, enum hk_claim_of of, const char *by,
              const char *format, ...) {
  if (claims->status != HOOKE_OK) return;
  const int64_t count = claims->count;
  claims->status = hk_grow((void **)&claims->claim, count, count + 1, sizeof *claims->claim);
  if (claims->status != HOOKE_OK) return;
  va_list args;
  va_start(args, format);
  struct hk_claim claim = {.key = key, .text = compose(format, args), .of = of};
  va_end(args);
  snprintf(claim.by, sizeof claim.by, "%s", by);
  claims->claim[count] = claim;
  if (claim.text)
    claims->count++;
  else
    claims->status = HOOKE_NO_MEMORY;
}

void hk_claims_release(struct hk_claims *claims) {
  for (int32_t k = 0; k < claims->count; k++)
    hk_free(claims->claim[k].text);
  hk_free(claims->claim);
  *claims = (struct hk_claims){.claim = NULL};
}
