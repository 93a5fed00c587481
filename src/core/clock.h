/* A monotonic clock. */
#pragma once

/* Seconds since a fixed moment. */
double hk_clock_seconds(void);
