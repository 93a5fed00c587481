/* Small systems by hand, in a few lines. Every call fails the running test when the library refuses. */
#pragma once

#include "hooke.h"

hooke_options *new_options(const char *table);
/* Options of a table, set by "name=value name=value", in which printf() puts the rest: numbers by %.17g,
 * which keeps every bit. */
__attribute__((format(printf, 2, 3))) hooke_options *options_with(const char *table, const char *words, ...);
__attribute__((format(printf, 2, 3))) void set_options(hooke_options *options, const char *words, ...);

/* Adds a part, with its options likewise, to a system, NULL for a new one, and returns that. */
__attribute__((format(printf, 4, 5))) hooke_system *small_part(hooke_system *system, const char *kind,
                                                               const char *name, const char *words, ...);
/* Adds a group of "springs", "altitude" springs or "anchors", likewise. */
__attribute__((format(printf, 6, 7))) void small_group(hooke_system *system, const char *kind,
                                                       const char *name, int64_t count,
                                                       const int64_t *members, const char *words, ...);
/* Commits a system, and returns it. */
hooke_system *committed(hooke_system *system);
/* Commits a system that falls at 9.81 m/s^2 along -y, and returns it. */
hooke_system *small_falling(hooke_system *system);
/* Sets options by such words, which are no format; the status of the first that is refused. */
int32_t try_words(hooke_options *options, const char *words);

/* An open system without particles. */
hooke_system *new_system(void);

/* One group of springs that share a material. */
struct springs {
  const char *law; /* NULL: strain */
  double stiffness, damping;
  double rest_length; /* -1: initial */
  int32_t pull_only;
};

/* An open system of `count` particles of one mass, particle 0 pinned if requested. */
hooke_system *small_system(int64_t count, const double *position, const double *velocity, double mass,
                           int32_t pin_first);
void small_springs(hooke_system *system, int64_t count, const int64_t *ends, struct springs springs);
/* The same by their members: springs_with(system, 1, ends, .stiffness = 9.0). */
#define springs_with(system, count, ends, ...)                                                               \
  small_springs((system), (count), (ends), (struct springs){__VA_ARGS__})

/* A committed mass on a spring of no length about the pinned origin: every coordinate is an oscillator of
 * angular frequency omega, without damping; it starts at (1, 0, 0) with velocity (0, 0.5, 0). */
hooke_system *small_oscillator(double omega);

/* A committed net of 40 springs between 12 particles at random places, so that stiffness and damping have no
 * modes in common: strengths within a factor of 100 or 1000, those of dampers about `damping`; velocities are
 * up to `speed` in each direction, that of a pinned first particle 0. */
enum { SMALL_NET_PARTICLES = 12, SMALL_NET_SPRINGS = 40 };
hooke_system *small_net(uint64_t seed, double damping, double speed, int32_t pin_first);

/* A committed cloth of 1 m and 0.2 kg with `side` x `side` particles, let go from horizontal between two
 * pinned corners; structural and shear springs of one stiffness [N] and damping [N s]. */
hooke_system *small_cloth(int64_t side, double stiffness, double damping);

/* A committed undamped cloth of `side` x `side` particles that falls, pinned at one corner, and crumples:
 * chaotic after a second or so. */
hooke_system *small_crumpling_cloth(int64_t side);

/* A callback that adds no force. */
int32_t idle_force(int64_t n, double t, const double *q, const double *v, double *force, void *ctx);

/* Six times the volume of the tetrahedron with these corners, with its sign. */
double volume_of(const double *q, const int64_t *corners);
