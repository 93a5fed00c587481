/* A number by which a system is known again. */
#ifndef HOOKE_MODEL_CHECK_VALUE_H
#define HOOKE_MODEL_CHECK_VALUE_H

#include "model/system.h"

/* CRC-32 over everything that the motion of a committed system hangs on: particles, springs, bending and
 * altitude springs, gravity, drag, drives. Of callbacks it knows only that they are there. */
uint32_t hk_system_check_value(const hooke_system *system);

#endif
