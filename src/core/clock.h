/* A clock that only goes forward. */
#ifndef HOOKE_CORE_CLOCK_H
#define HOOKE_CORE_CLOCK_H

/* Seconds since some fixed moment. */
double hk_clock_seconds(void);

#endif
