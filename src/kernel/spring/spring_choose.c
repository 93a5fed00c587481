/* The instruction sets that the loops were compiled for, and those that this machine runs. */
#include "kernel/spring/spring_loops.h"

#include <stdatomic.h>
#include <stddef.h>

#ifndef HOOKE_KERNEL_X86
#define HOOKE_KERNEL_X86 0
#endif

extern const struct hk_spring_set hk_spring_set_baseline;

#if HOOKE_KERNEL_X86

#include <cpuid.h>

extern const struct hk_spring_set hk_spring_set_avx2, hk_spring_set_avx512;

static const struct hk_spring_set *const sets[] = {&hk_spring_set_baseline, &hk_spring_set_avx2,
                                                   &hk_spring_set_avx512};

/* Bits of XCR0: the registers that the system keeps for each thread. */
enum { KEEPS_AVX = 0x06, KEEPS_AVX512 = 0xe6 };

static uint32_t kept_registers(void) {
  uint32_t a, b, c, d;
  if (!__get_cpuid(1, &a, &b, &c, &d) || !(c & bit_OSXSAVE)) return 0;
  __asm__("xgetbv" : "=a"(a), "=d"(d) : "c"(0));
  return a;
}

/* Asks the processor: __builtin_cpu_supports() reads a table of the compiler's library, which zig's leaves
 * empty. */
static int32_t count_sets(void) {
  const uint32_t avx512 = bit_AVX512F | bit_AVX512DQ | bit_AVX512VL | bit_AVX512BW, kept = kept_registers();
  uint32_t a, b, c, d;
  if (!__get_cpuid_count(7, 0, &a, &b, &c, &d)) return 1;
  if ((kept & KEEPS_AVX) != KEEPS_AVX || !(b & bit_AVX2)) return 1;
  return (kept & KEEPS_AVX512) == KEEPS_AVX512 && (b & avx512) == avx512 ? 3 : 2;
}

#else

static const struct hk_spring_set *const sets[] = {&hk_spring_set_baseline};

static int32_t count_sets(void) {
  return 1;
}

#endif

/* The number of sets that this machine runs, 0 before the first call: asking may take a microsecond. */
static _Atomic int32_t known;

const struct hk_spring_set *hk_spring_set(int32_t set) {
  int32_t count = atomic_load_explicit(&known, memory_order_relaxed);
  if (count == 0) {
    count = count_sets();
    atomic_store_explicit(&known, count, memory_order_relaxed);
  }
  return set >= 0 && set < count ? sets[count - 1 - set] : NULL;
}

const char *hk_kernel_instructions(void) {
  return hk_spring_set(0)->name;
}
