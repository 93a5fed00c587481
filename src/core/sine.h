/* Sine and cosine that give the same bits on every machine, which those of the C library do not. */
#ifndef HOOKE_CORE_SINE_H
#define HOOKE_CORE_SINE_H

/* sin and cos of 2 pi `turns`; accurate to 1e-15 for any number of turns that a double still resolves. */
void hk_sine_of_turns(double turns, double *sine, double *cosine);

#endif
