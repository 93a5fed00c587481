/* For sources that are compiled once per instruction set, with HOOKE_ISA naming it. */
#ifndef HOOKE_KERNEL_ISA_H
#define HOOKE_KERNEL_ISA_H

#define HOOKE_JOIN_NAMES(a, b) a##b
#define HOOKE_JOIN(a, b)       HOOKE_JOIN_NAMES(a, b)
#define HOOKE_OF_ISA(name)     HOOKE_JOIN(name, HOOKE_ISA)

/* What the loop writes is apart from all arrays that it reads, so iterations may be reordered. */
#if defined(__clang__)
#define HOOKE_VECTORISE _Pragma("clang loop vectorize(assume_safety)")
#else
#define HOOKE_VECTORISE _Pragma("GCC ivdep")
#endif

#endif
