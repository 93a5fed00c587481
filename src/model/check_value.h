/* A number that identifies a system. */
#pragma once

#include "hooke/system.h"

#include <stddef.h>

/* CRC-32 over everything that determines the motion of a committed system: particles, all forces of the
 * table, drives, bodies. Callbacks enter only by their presence. */
uint32_t hk_system_check_value(const hooke_system *system);

/* What of it differs between two committed systems: "particles", "driven", "bodies", or a force, by its name.
 * NULL: nothing. */
const char *hk_system_difference(const hooke_system *one, const hooke_system *other);

/* Continue a value with `count` items of `size` bytes, or with one whole number. */
void hk_check_add(uint32_t *value, const void *bytes, int64_t count, size_t size);
void hk_check_whole(uint32_t *value, int64_t number);
