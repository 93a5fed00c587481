/* The damped oscillator x'' + 2 zeta x' + x = 0 (lengths in its amplitude, times in 1/omega): its solution,
 * and the result of a fixed-step method, both to more digits than the library has. */
#pragma once

#include <stdint.h>

/* x and x' at time tau from (x, x') = start. */
void oscillator_solution(long double zeta, long double tau, const long double start[2], long double end[2]);

/* One step H of a method as a matrix in rows; 0 if this file does not know the method. "verlet" solves for
 * the damping, and "verlet, explicit" does not. */
int32_t oscillator_step(const char *method, long double zeta, long double step, long double matrix[4]);

/* end = matrix^count start, by squaring. */
void oscillator_power(const long double matrix[4], int64_t count, const long double start[2],
                      long double end[2]);

/* The first step at which (x^2 + x'^2)/2 has risen by more than 100 times its initial value, where a run
 * counts as diverged; 0 if there is none in `count` steps. */
int64_t oscillator_diverges(const long double matrix[4], int64_t count, const long double start[2]);
