/* A monotonic clock. */
#ifndef HOOKE_CORE_CLOCK_H
#define HOOKE_CORE_CLOCK_H

/* Seconds since a fixed moment. */
double hk_clock_seconds(void);

#endif
