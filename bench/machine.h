/* The machine, as it says of itself. */
#ifndef BENCH_MACHINE_H
#define BENCH_MACHINE_H

struct machine {
  char cpu[128];
  long cores;         /* that are online */
  double l1d, l2, l3; /* of one core, or shared [KiB]; 0: not known */
  double memory;      /* [GiB] */
  char date[32];      /* ISO 8601, UTC */
};

void machine_read(struct machine *machine);

#endif
