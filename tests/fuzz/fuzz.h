/* Common parts of the fuzz targets: one function that takes an input, counts of how far inputs get, and
 * checks. */
#pragma once

#include "owned.h"

#include <stddef.h>
#include <stdint.h>

/* One input; returns 0. Called by libFuzzer and by replay.c. */
int LLVMFuzzerTestOneInput(const uint8_t *data, size_t size);

/* Counters in the file named by the variable HOOKE_FUZZ_TALLY, numbers of 64 bits that the driver reads:
 * executions, those past the syntax, accepted ones, nanoseconds of processor time. They survive any end of
 * the process. The first is to be called first with each input; the other two count an input once. */
void hooke_fuzz_begin(void);
void hooke_fuzz_is_past_syntax(void);
void hooke_fuzz_is_accepted(void);

/* Ends the process, which is a finding, unless `holds`. */
void hooke_fuzz_require(int holds, const char *what);

/* Requires that a failure (a status < 0) has a message: one non-empty line of UTF-8 without control
 * characters. */
void hooke_fuzz_require_message(void);

/* The same for scenes, whose faults have a line each: at most so many lines. */
enum { HOOKE_FUZZ_FAULTS = 21 };
void hooke_fuzz_require_lines(int most);

/* A path to a file with these bytes, until the next call. */
const char *hooke_fuzz_file(const void *data, size_t size);

/* 1 for one in `of` inputs, always the same ones: for expensive checks. */
int hooke_fuzz_is_chosen(const void *data, size_t size, uint32_t of);
