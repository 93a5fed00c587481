/* Facts about the machine, from the system. */
#pragma once

struct machine {
  char cpu[128];
  long cores;         /* online processors */
  double l1d, l2, l3; /* of one core, or shared [KiB]; 0: unknown */
  double memory;      /* [GiB] */
  char date[32];      /* ISO 8601, UTC */
};

void machine_read(struct machine *machine);
