/* hooke/system.h - the system: particles, springs and forces.
 *
 * A system is built by calls that add to it, then committed: checked as a whole, its springs sorted into
 * loops. From then on it is const; its pointers never move, and any number of threads may share it. Until
 * then it belongs to one thread. Units are SI throughout. Arrays of positions, velocities and forces are rows
 * of x y z, 3 doubles a particle.
 *
 * Springs (U energy, f force on the first end, x = q_i - q_j, r = |x|, u = x/r, v = v_i - v_j):
 *   strain law  U = 1/2 ks l0 (r/l0 - 1)^2      ks [N], kd [N s]     kappa = ks/l0, gamma = kd/l0
 *   length law  U = 1/2 k (r - l0)^2            k [N/m], kd [N s/m]  kappa = k,     gamma = kd
 *   both        f = -(kappa (r - l0) + gamma (v.u)) u
 * Two ends at the same position have no direction: the force is zero there by definition, and
 * hooke_system_coincident_springs() counts such springs. A spring with `compression` false only pulls: its
 * force is zero where r <= l0 and where damping would make it push.
 *
 * Bending acts on triples of particles a, b, c (springs two apart have no linear bending stiffness: their
 * energy grows with the fourth power of the curvature):
 *   U = c/2 |q_a - 2 q_b + q_c|^2               c [N/m]
 * A beam of bending stiffness B [N m^2] in pieces of length l has c = B/l^3. Three particles in a line at
 * equal distances have no bending force, wherever they are.
 *
 * Altitude springs (Selle, Lentine and Fedkiw 2008) act on tetrahedra of particles 0, 1, 2, 3: of its seven
 * altitudes (from particle 0, 1, 2 or 3 to the face of the others; between edges 01 and 23, 02 and 13, 03 and
 * 12) the one that is currently the shortest is a spring, between a particle and the point of the face below
 * it or the nearest points of the two edges:
 *   U = ks/(2 l) (h - l)^2                      ks [N], h the altitude, l its rest length
 * and damping kd/l dh/dt along it. Altitudes of an inverted tetrahedron are negative: the force turns it
 * back. U and the force jump where another altitude becomes the shortest. A tetrahedron whose particles are
 * in one line has no such force.
 *
 * Anchors are springs from a particle to a fixed point of space:
 *   U = 1/2 k (r - l0)^2                        k [N/m], r the distance from the point, l0 = 0 unless given
 *   f = -(k (r - l0) + kd (v.u)) u              kd [N s/m], u the direction from the point
 * At the point itself there is no direction, and the force is zero.
 *
 * Springs are numbered: groups in the order they were added, springs in the order of their pairs, then the
 * springs of parts; and so are triples, tetrahedra and anchors. Commit drops springs that have neither
 * stiffness nor damping: from then on only the remaining springs are numbered and counted. A group without
 * any keeps its name and place, with size 0. Gravity, drag and damping of 0 are likewise absent. All sums are
 * taken in that order, springs first, so results do not depend on threads or instruction sets. */
#ifndef HOOKE_SYSTEM_H
#define HOOKE_SYSTEM_H

#include "options.h"

#ifdef __cplusplus
extern "C" {
#endif

typedef struct hooke_system hooke_system;

/* Adds a force [N] on `n` particles at time t [s] to `force` (3n); q [m] and v [m/s] are 3n. Return 0 to go
 * on, anything else to stop. Never called concurrently on one integrator. Called with every q and v that a
 * method tries. */
typedef int32_t hooke_force(int64_t n, double t, const double *q, const double *v, double *force, void *ctx);

/* The arrays of a callback for a force, its product, a drive or a rate are valid during the call. Holding
 * them by the first (`more` 1) keeps all of them, with their numbers, until they are released as often (-1).
 * Returns how often they are held, once by the library. */
HOOKE_API int64_t hooke_rows_hold(const double *q, int32_t more);

/* Adds (df/dq) dq + (df/dv) dv of that force to `out` (3n). Return 0 to go on. */
typedef int32_t hooke_force_product(int64_t n, double t, const double *q, const double *v, const double *dq,
                                    const double *dv, double *out, void *ctx);

/* Writes the position [m] and velocity [m/s] at time t of `count` driven particles into q and v (3 count
 * each). Return 0 to go on, anything else to stop. It must depend on t alone. */
typedef int32_t hooke_drive(int64_t count, double t, double *q, double *v, void *ctx);

/* Writes x' = phi(t, x) (size n) into `rate`. Return 0 to go on, anything else to stop. */
typedef int32_t hooke_rate(int64_t n, double t, const double *x, double *rate, void *ctx);

/* ---- building ---- */

/* An empty system, owned by the caller. HOOKE_NO_MEMORY. */
HOOKE_API int32_t hooke_system_create(hooke_system **system);
/* Releases a system; objects made from it must not be used afterwards. NULL is allowed. */
HOOKE_API void hooke_system_destroy(hooke_system *system);

/* Sets the maximum memory [bytes] that the system may need, with that of an explicit method; 0: the machine's
 * memory, or its limit on the address space if that is less. An addition that would need more fails with
 * HOOKE_NO_MEMORY, before anything is allocated. HOOKE_BAD_VALUE for a negative number and NaN. */
HOOKE_API int32_t hooke_system_limit_memory(hooke_system *system, double bytes);

/* Adds `count` particles: `position` (3 count) [m], `velocity` (3 count) [m/s] or NULL for rest, and `mass` >
 * 0 [kg], `mass_count` being 1 (shared) or `count`. `first`, if not NULL, receives the number of the first
 * one. HOOKE_BAD_VALUE, HOOKE_BAD_CALL after commit, HOOKE_NO_MEMORY. */
HOOKE_API int32_t hooke_system_add_particles(hooke_system *system, int64_t count, const double *position,
                                             const double *velocity, int64_t mass_count, const double *mass,
                                             int64_t *first);

/* Pins particles: inverse mass 0. Naming one twice is allowed; commit refuses a moving one. */
HOOKE_API int32_t hooke_system_pin(hooke_system *system, int64_t count, const int64_t *particles);

/* Names a particle: a name takes the place of its number in scenes and in what is watched, such as "tip.y".
 * It is no number, has no '.', ':' or blank, and is not that of a part or of a group, which commit refuses.
 * HOOKE_BAD_VALUE, HOOKE_BAD_CALL after commit, HOOKE_NO_MEMORY. */
HOOKE_API int32_t hooke_system_name_particle(hooke_system *system, const char *name, int64_t particle);
/* The particle of a name; -1 if there is none. */
HOOKE_API int64_t hooke_system_named_particle(const hooke_system *system, const char *name);

/* Adds a group of `count` springs between the pairs in `ends` (2 count particle numbers, different within a
 * pair), with options "springs". `name` may be NULL. HOOKE_BAD_VALUE names the spring; HOOKE_BAD_CALL,
 * HOOKE_NO_MEMORY. */
HOOKE_API int32_t hooke_system_add_springs(hooke_system *system, const char *name, int64_t count,
                                           const int64_t *ends, const hooke_options *options);

/* Adds a group of `count` triples, 3 count particle numbers (different within a triple), for bending with
 * coefficients >= 0 [N/m], `coefficient_count` being 1 (shared) or `count`. `name` may be NULL.
 * HOOKE_BAD_VALUE names the triple; HOOKE_BAD_CALL, HOOKE_NO_MEMORY. */
HOOKE_API int32_t hooke_system_add_bending(hooke_system *system, const char *name, int64_t count,
                                           const int64_t *triples, int64_t coefficient_count,
                                           const double *coefficient);

/* Adds a group of `count` tetrahedra, 4 count particle numbers (different within one), with altitude springs
 * and options "altitude". Rest lengths are the seven altitudes at the positions that the particles were added
 * with. `name` may be NULL. HOOKE_BAD_VALUE names the tetrahedron, also if it is flat; HOOKE_BAD_CALL,
 * HOOKE_NO_MEMORY. */
HOOKE_API int32_t hooke_system_add_altitude(hooke_system *system, const char *name, int64_t count,
                                            const int64_t *tetrahedra, const hooke_options *options);

/* Adds a group of `count` anchors, springs from a particle to a fixed point, one for each of `particles`
 * (repeats are allowed), with options "anchors". Without `points` each particle is tied to its initial
 * position. `name` may be NULL. HOOKE_BAD_VALUE names the anchor; HOOKE_BAD_CALL, HOOKE_NO_MEMORY. */
HOOKE_API int32_t hooke_system_add_anchors(hooke_system *system, const char *name, int64_t count,
                                           const int64_t *particles, const hooke_options *options);

/* Adds a force to each of `count` free particles (repeats are allowed), with options "loads": F constant,
 * with the energy -F.q, or with the motion "harmonic" F sin(2 pi frequency t + phase), or with "table"
 * piecewise cubic through rows of F, as displacements of drives are. HOOKE_BAD_VALUE for a particle that is
 * pinned or driven, at commit if that came later; HOOKE_BAD_CALL, HOOKE_NO_MEMORY. */
HOOKE_API int32_t hooke_system_add_loads(hooke_system *system, int64_t count, const int64_t *particles,
                                         const hooke_options *options);

/* Adds an obstacle that pushes out `count` particles (-1: all free ones), with options "obstacles": a plane,
 * a sphere or a cylinder, with f = N n - friction N w/sqrt(w^2 + friction_speed^2), N = max(0, stiffness d +
 * damping d'), at depth d > 0; w is the tangential velocity against the obstacle. HOOKE_BAD_VALUE,
 * HOOKE_BAD_CALL, HOOKE_NO_MEMORY. */
HOOKE_API int32_t hooke_system_add_obstacle(hooke_system *system, int64_t count, const int64_t *particles,
                                            const hooke_options *options);

/* Makes particles one rigid body: mass, centre and inertia are theirs (points in a line and single points are
 * bodies, too), all forces act on them as on any other, and members of forces inside the body are dropped at
 * commit. Positions and velocities stay those of the particles: every step takes the body's motion from three
 * of them and writes all of them anew (docs/design.md). Of a body with pinned particles one is a point about
 * which it swings, two an axis, and three not in a line hold it still. If its particles are driven, all of
 * them are. Initial velocities have to be those of a rigid motion, or with `project` 1 become those of the
 * nearest one: with the same momentum and angular momentum. `name` may be NULL. Commit refuses a particle in
 * two bodies, and particles that all coincide. hooke_method_is_suited(name, "bodies") says which methods step
 * them; verlet takes damping and drag at the predicted velocity. HOOKE_BAD_VALUE, HOOKE_BAD_CALL,
 * HOOKE_NO_MEMORY. */
HOOKE_API int32_t hooke_system_add_body(hooke_system *system, const char *name, int64_t count,
                                        const int64_t *particles, int32_t project);

/* Where the motion starts, if not where the particles were given, in place of an earlier call: positions [m]
 * and velocities [m/s], 3 `count` each, of all particles there will be; `velocity` NULL: those given. Rest
 * lengths, bodies, clamps and anchors stay those of the given, undeformed positions. Commit wants one place
 * for each particle, for a pinned one its own; a driven one starts where its motion says. HOOKE_BAD_VALUE,
 * HOOKE_BAD_CALL after commit, HOOKE_NO_MEMORY. */
HOOKE_API int32_t hooke_system_start_at(hooke_system *system, int64_t count, const double *position,
                                        const double *velocity);

/* Acceleration of every free particle, 3 numbers [m/s^2]. */
HOOKE_API int32_t hooke_system_set_gravity(hooke_system *system, const double *gravity);

/* Factors phi of gravity, of any sign, on `count` particles from number `first` on, `factor_count` being 1
 * (shared) or `count`: a = w f + phi g, so weight less buoyancy over weight. They act on bodies where they
 * are, and turn them, and are of the particles that exist; those to come have 1. HOOKE_BAD_VALUE,
 * HOOKE_BAD_CALL after commit, HOOKE_NO_MEMORY. */
HOOKE_API int32_t hooke_system_set_gravity_factor(hooke_system *system, int64_t first, int64_t count,
                                                  int64_t factor_count, const double *factor);

/* Ether drag f = -c v on every free particle, c >= 0 [N s/m]. It also brakes free fall, which spring damping
 * does not. Drag of each particle, quadratic drag and a wind are options of a scene: hooke_options_create()
 * "scene", hooke_scene_options_apply(). */
HOOKE_API int32_t hooke_system_set_drag(hooke_system *system, double coefficient);

/* "inertial", the default: M x'' = f. "overdamped": gamma x' = f, with drag as gamma > 0; masses serve
 * gravity alone and may be missing (`mass_count` 0, or masses of 0) without it; velocities and damping are
 * refused at commit. States have v = f/gamma, callback forces are given v = 0, and kinetic energy and momenta
 * are 0. To be called before particles without mass are added. HOOKE_BAD_VALUE for another word,
 * HOOKE_BAD_CALL. */
HOOKE_API int32_t hooke_system_set_dynamics(hooke_system *system, const char *dynamics);
HOOKE_API const char *hooke_system_dynamics(const hooke_system *system);

/* Adds a force of the caller's own; one a system. `product` may be NULL: difference quotients of `force` then
 * replace it. Both receive `ctx`, which must outlive the system. */
HOOKE_API int32_t hooke_system_set_force(hooke_system *system, hooke_force *force,
                                         hooke_force_product *product, void *ctx);

/* Says where that force is from: the function `name` of a shared library with this path and SHA-256, after
 * hooke_system_set_force(), which forgets it. Messages, results and trajectories name it, a run goes on with
 * the same digest and name alone (HOOKE_UNSUITED), and what it returns depends on its arguments alone.
 * The texts stay the caller's, and outlive the system. HOOKE_BAD_CALL without a force or after commit. */
HOOKE_API int32_t hooke_system_name_force(hooke_system *system, const char *file, const char *name,
                                          const char *digest);

/* A committed system with another such force, or with none (NULL), to run as often as it exists: it shares
 * the rest with `system`, which must outlive it and stays as it is. HOOKE_BAD_CALL before commit,
 * HOOKE_NO_MEMORY. */
HOOKE_API int32_t hooke_system_with_force(const hooke_system *system, hooke_force *force,
                                          hooke_force_product *product, void *ctx, hooke_system **with);

/* Creates and commits the system of `count` particles of a committed one, in ascending order, and of the
 * members of forces all of whose particles are among them, in their order; pins, drives and all that acts on
 * single particles are those of `system`, but parts are plain particles and groups. The force on a particle
 * has the same bits if all that acts on it was taken. HOOKE_UNSUITED with rigid bodies and callbacks;
 * HOOKE_BAD_VALUE, HOOKE_BAD_CALL before commit, HOOKE_NO_MEMORY. */
HOOKE_API int32_t hooke_system_take(const hooke_system *system, int64_t count, const int64_t *particles,
                                    hooke_system **taken);

/* Prescribe the motion of particles (inverse mass 0) about their initial positions:
 *   harmonic  q = q0 + amplitude sin(2 pi frequency t + phase), amplitude 3 numbers [m], frequency [Hz],
 *             phase [rad]
 *   table     q = q0 + d(t), d piecewise cubic through `samples` >= 2 rows of `displacement` (3 samples) [m]
 *             at ascending `time` [s]; its slope at a sample is that of the parabola through three
 *             neighbouring ones, so velocity is continuous from the first sample to the last; at rest before
 *             and after
 *   callback  q and v from `drive`
 * A particle is driven once at most, and not pinned as well. HOOKE_BAD_VALUE, HOOKE_BAD_CALL after commit,
 * HOOKE_NO_MEMORY. */
HOOKE_API int32_t hooke_system_drive_harmonic(hooke_system *system, int64_t count, const int64_t *particles,
                                              const double *amplitude, double frequency, double phase);
HOOKE_API int32_t hooke_system_drive_table(hooke_system *system, int64_t count, const int64_t *particles,
                                           int64_t samples, const double *time, const double *displacement);
HOOKE_API int32_t hooke_system_drive_callback(hooke_system *system, int64_t count, const int64_t *particles,
                                              hooke_drive *drive, void *ctx);

/* Checks the system as a whole, chooses its loops and makes it const. HOOKE_BAD_VALUE names the offending
 * item and leaves the system open; HOOKE_BAD_CALL if it was committed before; HOOKE_NO_MEMORY. */
HOOKE_API int32_t hooke_system_commit(hooke_system *system);

/* ---- queries (from any thread once committed) ---- */

HOOKE_API int32_t hooke_system_is_committed(const hooke_system *system);
HOOKE_API int64_t hooke_system_particle_count(const hooke_system *system);
/* A count; -1 for any other word:
 *   "springs", "bending" (triples), "altitude" (tetrahedra), "anchors", "loads": members of a force,
 *       before commit all that were added, afterwards those that act: commit drops those that
 *       have neither stiffness nor damping
 *   "dropped_springs"  springs that commit has dropped for having neither
 *   "free"     particles that are neither pinned nor driven
 *   "idle"     pinned particles that no member of a force and no callback acts on; 0 before commit. Steps
 *              skip blocks of 256 particles that are all idle, except where the particles of unordered
 *              springs are numbered anew
 *   "bodies"   rigid bodies;  "inside_bodies"  members of forces that commit has dropped inside them
 *   "forces"   number of hooke_system_force_name();  "derived"  of hooke_system_derived_value()
 *   "blocks"   of hooke_system_derivative_pattern(); -1 before commit and without memory
 *   "memory"   memory of the committed system [bytes];  "spring_memory"  the part of it that grows with the
 *              number of springs */
HOOKE_API int64_t hooke_system_count(const hooke_system *system, const char *what);

/* Groups of a force: "springs", "bending", "altitude", "anchors" or "loads". Their number, -1 for another
 * word; the name of group `group`, "" if it has none, NULL if there is no such group; the number of its
 * members, 0 if there is none. */
HOOKE_API int64_t hooke_system_group_count(const hooke_system *system, const char *force);
HOOKE_API const char *hooke_system_group_name(const hooke_system *system, const char *force, int64_t group);
HOOKE_API int64_t hooke_system_group_size(const hooke_system *system, const char *force, int64_t group);

/* Rigid bodies, numbered in the order in which they were added. The name, NULL if there is no such body; the
 * number of its particles (0), which `particles`, unless NULL, receives. */
HOOKE_API const char *hooke_system_body_name(const hooke_system *system, int64_t body);
HOOKE_API int64_t hooke_system_body_particles(const hooke_system *system, int64_t body, int64_t *particles);
/* Mass [kg] of its free particles and the moments of inertia [kg m^2] about the axes through its point,
 * ascending (4 numbers); the point is the centre of mass, or the first pinned particle. A body with two
 * pinned points has one moment, about their axis, before two zeros. HOOKE_BAD_CALL before commit;
 * HOOKE_BAD_VALUE if there is no such body, or it does not move by itself. */
HOOKE_API int32_t hooke_system_body_inertia(const hooke_system *system, int64_t body, double *inertia);
/* Its motion at q and v (3n each), 13 numbers: position of the point [m], quaternion from the body's axes to
 * those of space (real part first), velocity of the point [m/s], angular momentum about the point [kg m^2/s].
 * The same failures. */
HOOKE_API int32_t hooke_system_body_motion(const hooke_system *system, int64_t body, const double *q,
                                           const double *v, double *motion);

/* Obstacles, numbered in the order in which they were added. "plane", "sphere" or "cylinder", NULL if there
 * is no such obstacle; where it is at time t, 7 numbers: its point or centre [m], its unit normal or axis (0
 * of a sphere) and its radius [m] (0 of a plane). HOOKE_BAD_VALUE if there is no such obstacle. */
HOOKE_API const char *hooke_system_obstacle_shape(const hooke_system *system, int64_t obstacle);
HOOKE_API int32_t hooke_system_obstacle_place(const hooke_system *system, int64_t obstacle, double t,
                                              double *place);

/* Masses [kg] (n; 0: not given) and inverse masses [1/kg] (n; 0 = pinned or driven; of an overdamped system
 * 1/gamma) of all particles; NULL before commit. */
HOOKE_API const double *hooke_system_mass(const hooke_system *system);
HOOKE_API const double *hooke_system_inverse_mass(const hooke_system *system);

/* Number of particles of one member of a force: 2 of a spring, 3 of bending, 4 of a tetrahedron, 1 of an
 * anchor or a load; 0 for a force without members and for another word. */
HOOKE_API int64_t hooke_member_particles(const char *force);
/* Copies particles, stiffness [N/m], damping [N s/m] and rest length [m] of all hooke_system_count(system,
 * force) members of a force, in order. Arrays have one number a member, `particles` hooke_member_particles()
 * numbers; each array may be NULL. The stiffness of a curve is its slope at the rest length. For bending the
 * stiffness is its coefficient and the other numbers are zero; of loads all three are. Altitude springs have
 * stiffness [N], damping [N s] and 7 rest lengths each, in the order above; these are negative if the volume
 * (x_1 - x_0).((x_2 - x_0) x (x_3 - x_0)) is. HOOKE_BAD_CALL before commit; HOOKE_BAD_VALUE for another word.
 */
HOOKE_API int32_t hooke_system_members(const hooke_system *system, const char *force, int64_t *particles,
                                       double *stiffness, double *damping, double *rest_length);
/* 1 for every spring that resists compression, 0 for one that only pulls. HOOKE_BAD_CALL before commit. */
HOOKE_API int32_t hooke_system_compression(const hooke_system *system, double *compression);
/* Copies the point of every anchor [m] (3 each). HOOKE_BAD_CALL before commit. */
HOOKE_API int32_t hooke_system_anchor_points(const hooke_system *system, double *points);
/* Altitude of every tetrahedron that acts at q [m], negative where it is inverted; 0 where none acts. */
HOOKE_API int32_t hooke_system_altitude_lengths(const hooke_system *system, const double *q, double *length);

/* Numbers that parts derived from their options (`density`, `damping_ratio`, ...): texts "part", "family"
 * (NULL: the part as a whole), "name" and "unit", and the value. NULL and NaN past the last one. */
HOOKE_API const char *hooke_system_derived_text(const hooke_system *system, int64_t number, const char *what);
HOOKE_API double hooke_system_derived_value(const hooke_system *system, int64_t number);

/* Names of the forces that this system computes ("springs", "bending", "altitude", "anchors", "fluid_drag",
 * "drag", "quadratic_drag", "wind", "loads", "callback", "gravity"), NULL past the last; absent forces cost
 * nothing. */
HOOKE_API const char *hooke_system_force_name(const hooke_system *system, int64_t force);

/* ---- forces and energies at q, v (3n each), committed systems only ----
 * Functions with a status allocate scratch and return HOOKE_BAD_CALL before commit, HOOKE_NO_MEMORY, or
 * HOOKE_STOPPED if a callback asked for it. Those that return a double give NaN before commit. */

/* Force on every particle [N], 3n: springs, bending, altitude springs, anchors, drag, loads, callback,
 * m phi g on free particles. */
HOOKE_API int32_t hooke_system_force(const hooke_system *system, double t, const double *q, const double *v,
                                     double *force);
/* Acceleration of every particle [m/s^2], 3n: w f + phi g, zero where pinned or driven; that of the rigid
 * motion in a body; of an overdamped system the velocity f/gamma [m/s]. */
HOOKE_API int32_t hooke_system_acceleration(const hooke_system *system, double t, const double *q,
                                            const double *v, double *acceleration);
/* Tension of every spring [N], in spring order: the force along it, of its law, curve and scale at time t,
 * with damping; positive where it pulls its ends together, 0 where a spring that only pulls is slack. */
HOOKE_API int32_t hooke_system_tension(const hooke_system *system, double t, const double *q, const double *v,
                                       double *tension);
/* Force of the support of every particle [N], 3n: m a - f where one is pinned or driven, with m the mass as
 * it was given, a the acceleration of its drive, and f all forces on it and its own weight; 0 where a
 * particle is free. At rest their sum is that of weights and loads with the other sign. NaN in a rigid body,
 * whose inner forces are not known, and of a drive by a callback, whose acceleration is not; in an overdamped
 * system nothing has inertia. */
HOOKE_API int32_t hooke_system_reaction(const hooke_system *system, double t, const double *q,
                                        const double *v, double *reaction);
/* What has no direction at q, and so no force: springs whose ends coincide although their rest length is not
 * zero, and particles at the centre or on the axis of an obstacle, which is where it is at time 0. */
HOOKE_API int64_t hooke_system_coincident_springs(const hooke_system *system, const double *q);

/* out = (df/dq) dq + (df/dv) dv, 3n, of the force above. A callback without a product is differentiated by
 * central differences. */
HOOKE_API int32_t hooke_system_derivative_product(const hooke_system *system, double t, const double *q,
                                                  const double *v, const double *dq, const double *dv,
                                                  double *out);

/* df/dq and df/dv as sparse 3x3 blocks, callbacks left out, in compressed rows: row_start (n + 1), column
 * (count, ascending within a row, the diagonal always there), and blocks of 9 in row order, `count` being
 * hooke_system_count(system, "blocks"). Either block array may be NULL. The first function is of time 0. */
HOOKE_API int32_t hooke_system_derivative_pattern(const hooke_system *system, int64_t *row_start,
                                                  int64_t *column);
HOOKE_API int32_t hooke_system_derivative_blocks(const hooke_system *system, const double *q, const double *v,
                                                 double *dfdq, double *dfdv);
HOOKE_API int32_t hooke_system_derivative_blocks_at(const hooke_system *system, double t, const double *q,
                                                    const double *v, double *dfdq, double *dfdv);

/* An energy [J]: "kinetic" of the free particles; "springs", "bending", "altitude", "anchors", "loads" (the
 * sum of -F.q of constant ones), "gravity" (of -m phi g.q); "potential", their sum; "total". The kinetic
 * energy needs v alone, the others q alone; arrays that are not needed may be NULL. A callback has no energy.
 * NaN for another word. Sums are compensated (Neumaier 1974). They overflow to infinity. The first function
 * is of time 0. */
HOOKE_API double hooke_system_energy(const hooke_system *system, const char *what, const double *q,
                                     const double *v);
HOOKE_API double hooke_system_energy_at(const hooke_system *system, const char *what, double t,
                                        const double *q, const double *v);
/* Power that damping and drag turn into heat [W], >= 0. The first function is of time 0. */
HOOKE_API double hooke_system_dissipated_power(const hooke_system *system, const double *q, const double *v);
HOOKE_API double hooke_system_dissipated_power_at(const hooke_system *system, double t, const double *q,
                                                  const double *v);
/* Momentum [kg m/s] and angular momentum about the origin [kg m^2/s] of the free particles, 3 numbers; zeros
 * before commit. */
HOOKE_API void hooke_system_momentum(const hooke_system *system, const double *v, double *momentum);
HOOKE_API void hooke_system_angular_momentum(const hooke_system *system, const double *q, const double *v,
                                             double *angular_momentum);

#ifdef __cplusplus
}
#endif
#endif
