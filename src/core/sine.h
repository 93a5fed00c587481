/* Sine and cosine with the same bits on every machine, unlike those of the C library. */
#pragma once

/* sin and cos of 2 pi `turns`; accurate to 1e-15 for any number of turns that a double still resolves. */
void hk_sine_of_turns(double turns, double *sine, double *cosine);
