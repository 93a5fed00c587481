/* The files that a system was read from, which no output may replace. They are told apart by what they are,
 * and not by their names. */
#pragma once

#include "hooke/system.h"

/* Notes a file; the scene itself last. HOOKE_NO_MEMORY. */
int32_t hk_inputs_note(hooke_system *system, const char *path, int32_t is_scene);

/* HOOKE_BAD_VALUE if `output`, or a checkpoint beside it, is one of them; HOOKE_NO_MEMORY. Saved again, a
 * scene may replace itself: hk_inputs_refuse_save(). */
int32_t hk_inputs_refuse(const hooke_system *system, const char *output);
int32_t hk_inputs_refuse_save(const hooke_system *system, const char *output);

/* The same for one input. */
int32_t hk_input_refuse(const char *input, const char *output);
