/* Claims: what a measurement says of its result, in sentences, the most important first. The program, pages,
 * bindings and files show these texts and compose none of their own. What to do is no claim: it is data. */
#pragma once

#include "core/table/column.h"

/* What a claim is true of. */
enum hk_claim_of { HOOKE_OF_WHOLE, HOOKE_OF_PART, HOOKE_OF_UNKNOWN };

struct hk_claim {
  const char *key;
  char *text;
  enum hk_claim_of of;
  char by[64]; /* what it rests on: methods, or a kind of run */
};

/* Starts as zeros. A failure is kept in `status`; later claims are left out. */
struct hk_claims {
  struct hk_claim *claim;
  int32_t count, status;
};

extern const struct hk_table hk_claims_table; /* of a struct hk_claims */

/* Adds a claim after the others. `key` stays valid, `by` is copied; numbers are as of hk_print(). */
void hk_claim(struct hk_claims *claims, const char *key, enum hk_claim_of of, const char *by,
              const char *format, ...) __attribute__((format(printf, 5, 6)));

void hk_claims_release(struct hk_claims *claims);
