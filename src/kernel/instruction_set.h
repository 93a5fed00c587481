/* For files that are compiled once per instruction set: HOOKE_ISA names the set, and the exported names. */
#pragma once

#include "kernel/energy_loops.h"
#include "kernel/spring/damper_loops.h"
#include "kernel/spring/strided_loops.h"
#include "kernel/spring/spring_loops.h"
#include "kernel/spring/tangent_loops.h"
#include "kernel/triangle_loops.h"
#include "kernel/vector_loops.h"

#define HOOKE_JOIN_NAMES(a, b) a##b
#define HOOKE_JOIN(a, b)       HOOKE_JOIN_NAMES(a, b)
#define HOOKE_OF_ISA(name)     HOOKE_JOIN(name, HOOKE_ISA)

/* The output of the loop does not overlap any array that it reads, so iterations may be reordered. */
#if defined(__clang__)
#define HOOKE_VECTORISE _Pragma("clang loop vectorize(assume_safety)")
#else
#define HOOKE_VECTORISE _Pragma("GCC ivdep")
#endif

#define HOOKE_SPRING_SET       HOOKE_OF_ISA(hk_spring_set_)
#define HOOKE_STRIDED_LOOP     HOOKE_OF_ISA(hk_strided_loop_)
#define HOOKE_MOVE_LOOP        HOOKE_OF_ISA(hk_move_loop_)
#define HOOKE_TILED_LOOPS      HOOKE_OF_ISA(hk_tiled_loops_)
#define HOOKE_BENDING_LOOP     HOOKE_OF_ISA(hk_bending_loop_)
#define HOOKE_ENERGY_SET       HOOKE_OF_ISA(hk_energy_set_)
#define HOOKE_DAMPER_LOOP      HOOKE_OF_ISA(hk_damper_loop_)
#define HOOKE_DERIVATIVE_LOOP  HOOKE_OF_ISA(hk_derivative_loop_)
#define HOOKE_TANGENT_SET      HOOKE_OF_ISA(hk_tangent_set_)
#define HOOKE_TETRAHEDRON_LOOP HOOKE_OF_ISA(hk_tetrahedron_loop_)
#define HOOKE_TRIANGLE_SET     HOOKE_OF_ISA(hk_triangle_set_)
#define HOOKE_VECTOR_SET       HOOKE_OF_ISA(hk_vector_set_)

extern const struct hk_spring_set HOOKE_SPRING_SET;
hk_strided_loop HOOKE_STRIDED_LOOP;
hk_move_loop HOOKE_MOVE_LOOP;
extern const struct hk_tiled_loops HOOKE_TILED_LOOPS;
hk_bending_loop HOOKE_BENDING_LOOP;
extern const struct hk_energy_set HOOKE_ENERGY_SET;
hk_damper_loop HOOKE_DAMPER_LOOP;
hk_derivative_loop HOOKE_DERIVATIVE_LOOP;
extern const struct hk_tangent_set HOOKE_TANGENT_SET;
hk_tetrahedron_loop HOOKE_TETRAHEDRON_LOOP;
extern const struct hk_triangle_set HOOKE_TRIANGLE_SET;
extern const struct hk_vector_set HOOKE_VECTOR_SET;
