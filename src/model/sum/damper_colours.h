/* The colours of damped springs: of each the lowest that no damped spring before it has at either of its
 * ends. A spring that is not damped, or both ends of which are held, has none. */
#ifndef HOOKE_MODEL_SUM_DAMPER_COLOURS_H
#define HOOKE_MODEL_SUM_DAMPER_COLOURS_H

#include "model/particles.h"

/* Class 2 c has the springs of colour c that push too, and 2 c + 1 those that only pull: `first` .. of the
 * next one, in ascending number. */
struct hk_damper_colours {
  int64_t springs, classes;
  int32_t pulling; /* 1: some only pull */
  int64_t *first;  /* classes + 1 */
  int32_t *head, *tail;
  int64_t *slot; /* of each spring of the system, -1 of one without a colour; NULL once dropped */
};

/* HOOKE_NO_MEMORY leaves what hk_damper_colours_release() releases. */
int32_t hk_damper_colours_create(const hooke_system *system, struct hk_damper_colours *colours);
void hk_damper_colours_drop_places(struct hk_damper_colours *colours);
void hk_damper_colours_release(struct hk_damper_colours *colours);
/* Bytes, with places only as long as they are there. */
int64_t hk_damper_colours_memory(const struct hk_damper_colours *colours);

#endif
