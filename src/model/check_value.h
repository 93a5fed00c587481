/* A number by which a system is known again. */
#ifndef HOOKE_MODEL_CHECK_VALUE_H
#define HOOKE_MODEL_CHECK_VALUE_H

#include "model/system.h"

/* CRC-32 over everything that determines the motion of a committed system: particles, springs, bending and
 * altitude springs, gravity, drag, drives. Of callbacks it knows only that they are there. */
uint32_t hk_system_check_value(const hooke_system *system);

/* Goes on with a value: `count` pieces of `size` bytes, or one whole number. */
void hk_check_add(uint32_t *value, const void *bytes, int64_t count, size_t size);
void hk_check_whole(uint32_t *value, int64_t number);

#endif
