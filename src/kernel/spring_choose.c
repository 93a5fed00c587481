/* The instruction sets that the loops were compiled for, and those that this machine runs. */
#include "kernel/spring_loops.h"

#include <stddef.h>

#ifndef HOOKE_KERNEL_X86
#define HOOKE_KERNEL_X86 0
#endif

extern const struct hk_spring_set hk_spring_set_baseline;

#if HOOKE_KERNEL_X86
extern const struct hk_spring_set hk_spring_set_avx2, hk_spring_set_avx512;
#endif

const struct hk_spring_set *hk_spring_set(int32_t set) {
  const struct hk_spring_set *found[3];
  int32_t count = 0;
#if HOOKE_KERNEL_X86
  if (__builtin_cpu_supports("avx512f") && __builtin_cpu_supports("avx512dq") &&
      __builtin_cpu_supports("avx512vl") && __builtin_cpu_supports("avx512bw")) {
    found[count++] = &hk_spring_set_avx512;
  }
  if (__builtin_cpu_supports("avx2")) found[count++] = &hk_spring_set_avx2;
#endif
  found[count++] = &hk_spring_set_baseline;
  return set >= 0 && set < count ? found[set] : NULL;
}

const char *hk_kernel_instructions(void) {
  return hk_spring_set(0)->name;
}
