#ifndef BENCH_BANDWIDTH_H
#define BENCH_BANDWIDTH_H

/* Bytes a second of a triad a = b + s c over arrays far larger than any cache, 24 bytes an element, best of several; 0
 * without memory (McCalpin 1995). */
double bandwidth_measure(void);

/* Seconds since some moment. */
double bench_seconds(void);

#endif
