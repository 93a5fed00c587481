/* clang-format off */
#ifndef HOOKE_H
#define HOOKE_H
#pragma once
#include <stdint.h>
#ifdef __cplusplus
extern "C" {
#endif
#ifndef HOOKE_API
#if defined(_WIN32)
#define HOOKE_API
#else
#define HOOKE_API __attribute__((visibility("default")))
#endif
#endif
#define HOOKE_VERSION "0.3.0"
#define HOOKE_ABI     1
#define HOOKE_OK            0
#define HOOKE_STOPPED       1
#define HOOKE_DIVERGED      2
#define HOOKE_STEP_LIMIT    3
#define HOOKE_NO_MEMORY     (-1)
#define HOOKE_BAD_VALUE     (-2)
#define HOOKE_BAD_CALL      (-3)
#define HOOKE_IO_FAILED     (-4)
#define HOOKE_NOT_BUILT     (-5)
#define HOOKE_UNSUITED      (-6)
#define HOOKE_SOLVER_FAILED (-7)
#define HOOKE_INTERNAL      (-8)
HOOKE_API const char *hooke_last_error(void);
HOOKE_API const char *hooke_status_name(int32_t status);
HOOKE_API const char *hooke_version(void);
HOOKE_API int32_t hooke_abi(void);
HOOKE_API const char *hooke_build_fact(const char *what);
#ifdef __cplusplus
}
#endif
#endif
#ifndef HOOKE_OPTIONS_H
#define HOOKE_OPTIONS_H
#ifdef __cplusplus
extern "C" {
#endif
typedef struct hooke_options hooke_options;
HOOKE_API int32_t hooke_options_create(const char *name, hooke_options **options);
HOOKE_API int32_t hooke_options_copy(const hooke_options *options, hooke_options **copy);
HOOKE_API void hooke_options_destroy(hooke_options *options);
HOOKE_API int32_t hooke_options_set_number(hooke_options *options, const char *name, double value);
HOOKE_API int32_t hooke_options_set_numbers(hooke_options *options, const char *name, int64_t count,
                                            const double *values);
HOOKE_API int32_t hooke_options_set_text(hooke_options *options, const char *name, const char *text);
HOOKE_API int32_t hooke_options_unset(hooke_options *options, const char *name);
HOOKE_API int32_t hooke_options_is_set(const hooke_options *options, const char *name);
HOOKE_API int64_t hooke_options_number_count(const hooke_options *options, const char *name);
HOOKE_API const double *hooke_options_numbers(const hooke_options *options, const char *name);
HOOKE_API double hooke_options_number(const hooke_options *options, const char *name);
HOOKE_API const char *hooke_options_text(const hooke_options *options, const char *name);
HOOKE_API int64_t hooke_options_row_count(const hooke_options *options);
HOOKE_API const char *hooke_options_row(const hooke_options *options, int64_t row, const char *property);
HOOKE_API double hooke_options_row_number(const hooke_options *options, int64_t row, const char *property);
#ifdef __cplusplus
}
#endif
#endif
#ifndef HOOKE_SYSTEM_H
#define HOOKE_SYSTEM_H
#ifdef __cplusplus
extern "C" {
#endif
typedef struct hooke_system hooke_system;
typedef int32_t hooke_force(int64_t n, double t, const double *q, const double *v, double *force, void *ctx);
HOOKE_API int64_t hooke_rows_hold(const double *q, int32_t more);
typedef int32_t hooke_force_product(int64_t n, double t, const double *q, const double *v, const double *dq,
                                    const double *dv, double *out, void *ctx);
typedef int32_t hooke_drive(int64_t count, double t, double *q, double *v, void *ctx);
typedef int32_t hooke_rate(int64_t n, double t, const double *x, double *rate, void *ctx);
HOOKE_API int32_t hooke_system_create(hooke_system **system);
HOOKE_API void hooke_system_destroy(hooke_system *system);
HOOKE_API int32_t hooke_system_limit_memory(hooke_system *system, double bytes);
HOOKE_API int32_t hooke_system_add_particles(hooke_system *system, int64_t count, const double *position,
                                             const double *velocity, int64_t mass_count, const double *mass,
                                             int64_t *first);
HOOKE_API int32_t hooke_system_pin(hooke_system *system, int64_t count, const int64_t *particles);
HOOKE_API int32_t hooke_system_name_particle(hooke_system *system, const char *name, int64_t particle);
HOOKE_API int64_t hooke_system_named_particle(const hooke_system *system, const char *name);
HOOKE_API int32_t hooke_system_add_springs(hooke_system *system, const char *name, int64_t count,
                                           const int64_t *ends, const hooke_options *options);
HOOKE_API int32_t hooke_system_add_bending(hooke_system *system, const char *name, int64_t count,
                                           const int64_t *triples, int64_t coefficient_count,
                                           const double *coefficient);
HOOKE_API int32_t hooke_system_add_altitude(hooke_system *system, const char *name, int64_t count,
                                            const int64_t *tetrahedra, const hooke_options *options);
HOOKE_API int32_t hooke_system_add_anchors(hooke_system *system, const char *name, int64_t count,
                                           const int64_t *particles, const hooke_options *options);
HOOKE_API int32_t hooke_system_add_loads(hooke_system *system, int64_t count, const int64_t *particles,
                                         const hooke_options *options);
HOOKE_API int32_t hooke_system_add_obstacle(hooke_system *system, int64_t count, const int64_t *particles,
                                            const hooke_options *options);
HOOKE_API int32_t hooke_system_add_body(hooke_system *system, const char *name, int64_t count,
                                        const int64_t *particles, int32_t project);
HOOKE_API int32_t hooke_system_start_at(hooke_system *system, int64_t count, const double *position,
                                        const double *velocity);
HOOKE_API int32_t hooke_system_set_gravity(hooke_system *system, const double *gravity);
HOOKE_API int32_t hooke_system_set_gravity_factor(hooke_system *system, int64_t first, int64_t count,
                                                  int64_t factor_count, const double *factor);
HOOKE_API int32_t hooke_system_set_drag(hooke_system *system, double coefficient);
HOOKE_API int32_t hooke_system_set_dynamics(hooke_system *system, const char *dynamics);
HOOKE_API const char *hooke_system_dynamics(const hooke_system *system);
HOOKE_API int32_t hooke_system_set_force(hooke_system *system, hooke_force *force,
                                         hooke_force_product *product, void *ctx);
HOOKE_API int32_t hooke_system_name_force(hooke_system *system, const char *file, const char *name,
                                          const char *digest);
HOOKE_API int32_t hooke_system_with_force(const hooke_system *system, hooke_force *force,
                                          hooke_force_product *product, void *ctx, hooke_system **with);
HOOKE_API int32_t hooke_system_take(const hooke_system *system, int64_t count, const int64_t *particles,
                                    hooke_system **taken);
HOOKE_API int32_t hooke_system_drive_harmonic(hooke_system *system, int64_t count, const int64_t *particles,
                                              const double *amplitude, double frequency, double phase);
HOOKE_API int32_t hooke_system_drive_table(hooke_system *system, int64_t count, const int64_t *particles,
                                           int64_t samples, const double *time, const double *displacement);
HOOKE_API int32_t hooke_system_drive_callback(hooke_system *system, int64_t count, const int64_t *particles,
                                              hooke_drive *drive, void *ctx);
HOOKE_API int32_t hooke_system_commit(hooke_system *system);
HOOKE_API int32_t hooke_system_is_committed(const hooke_system *system);
HOOKE_API int64_t hooke_system_particle_count(const hooke_system *system);
HOOKE_API int64_t hooke_system_count(const hooke_system *system, const char *what);
HOOKE_API int64_t hooke_system_group_count(const hooke_system *system, const char *force);
HOOKE_API const char *hooke_system_group_name(const hooke_system *system, const char *force, int64_t group);
HOOKE_API int64_t hooke_system_group_size(const hooke_system *system, const char *force, int64_t group);
HOOKE_API const char *hooke_system_body_name(const hooke_system *system, int64_t body);
HOOKE_API int64_t hooke_system_body_particles(const hooke_system *system, int64_t body, int64_t *particles);
HOOKE_API int32_t hooke_system_body_inertia(const hooke_system *system, int64_t body, double *inertia);
HOOKE_API int32_t hooke_system_body_motion(const hooke_system *system, int64_t body, const double *q,
                                           const double *v, double *motion);
HOOKE_API const char *hooke_system_obstacle_shape(const hooke_system *system, int64_t obstacle);
HOOKE_API int32_t hooke_system_obstacle_place(const hooke_system *system, int64_t obstacle, double t,
                                              double *place);
HOOKE_API const double *hooke_system_mass(const hooke_system *system);
HOOKE_API const double *hooke_system_inverse_mass(const hooke_system *system);
HOOKE_API int64_t hooke_member_particles(const char *force);
HOOKE_API int32_t hooke_system_members(const hooke_system *system, const char *force, int64_t *particles,
                                       double *stiffness, double *damping, double *rest_length);
HOOKE_API int32_t hooke_system_compression(const hooke_system *system, double *compression);
HOOKE_API int32_t hooke_system_anchor_points(const hooke_system *system, double *points);
HOOKE_API int32_t hooke_system_altitude_lengths(const hooke_system *system, const double *q, double *length);
HOOKE_API const char *hooke_system_derived_text(const hooke_system *system, int64_t number, const char *what);
HOOKE_API double hooke_system_derived_value(const hooke_system *system, int64_t number);
HOOKE_API const char *hooke_system_force_name(const hooke_system *system, int64_t force);
HOOKE_API int32_t hooke_system_force(const hooke_system *system, double t, const double *q, const double *v,
                                     double *force);
HOOKE_API int32_t hooke_system_acceleration(const hooke_system *system, double t, const double *q,
                                            const double *v, double *acceleration);
HOOKE_API int32_t hooke_system_tension(const hooke_system *system, double t, const double *q, const double *v,
                                       double *tension);
HOOKE_API int32_t hooke_system_reaction(const hooke_system *system, double t, const double *q,
                                        const double *v, double *reaction);
HOOKE_API int64_t hooke_system_coincident_springs(const hooke_system *system, const double *q);
HOOKE_API int32_t hooke_system_derivative_product(const hooke_system *system, double t, const double *q,
                                                  const double *v, const double *dq, const double *dv,
                                                  double *out);
HOOKE_API int32_t hooke_system_derivative_pattern(const hooke_system *system, int64_t *row_start,
                                                  int64_t *column);
HOOKE_API int32_t hooke_system_derivative_blocks(const hooke_system *system, const double *q, const double *v,
                                                 double *dfdq, double *dfdv);
HOOKE_API int32_t hooke_system_derivative_blocks_at(const hooke_system *system, double t, const double *q,
                                                    const double *v, double *dfdq, double *dfdv);
HOOKE_API double hooke_system_energy(const hooke_system *system, const char *what, const double *q,
                                     const double *v);
HOOKE_API double hooke_system_energy_at(const hooke_system *system, const char *what, double t,
                                        const double *q, const double *v);
HOOKE_API double hooke_system_dissipated_power(const hooke_system *system, const double *q, const double *v);
HOOKE_API double hooke_system_dissipated_power_at(const hooke_system *system, double t, const double *q,
                                                  const double *v);
HOOKE_API void hooke_system_momentum(const hooke_system *system, const double *v, double *momentum);
HOOKE_API void hooke_system_angular_momentum(const hooke_system *system, const double *q, const double *v,
                                             double *angular_momentum);
#ifdef __cplusplus
}
#endif
#endif
#ifndef HOOKE_PARTS_H
#define HOOKE_PARTS_H
#ifdef __cplusplus
extern "C" {
#endif
HOOKE_API const char *hooke_part_kind(int64_t kind, const char *what);
HOOKE_API int32_t hooke_system_add_part(hooke_system *system, const char *kind, const char *name,
                                        const hooke_options *options, int64_t *first, int64_t *count);
HOOKE_API int64_t hooke_system_part_count(const hooke_system *system, const char *part, const char *what);
HOOKE_API int32_t hooke_mesh_set(hooke_options *options, int64_t vertex_count, const double *vertices,
                                 int64_t triangle_count, const int64_t *triangles);
#ifdef __cplusplus
}
#endif
#endif
#ifndef HOOKE_STATE_H
#define HOOKE_STATE_H
#ifdef __cplusplus
extern "C" {
#endif
typedef struct hooke_state hooke_state;
HOOKE_API int32_t hooke_state_create(const hooke_system *system, hooke_state **state);
HOOKE_API int32_t hooke_state_create_first_order(int64_t size, hooke_state **state);
HOOKE_API int32_t hooke_state_create_second_order(int64_t size, hooke_state **state);
HOOKE_API int32_t hooke_system_create_second_order(hooke_force *force, hooke_force_product *product,
                                                   void *ctx, int64_t mass_count, const double *inverse_mass,
                                                   const hooke_state *start, hooke_system **system);
HOOKE_API int32_t hooke_system_create_first_order(hooke_rate *rate, void *ctx, const hooke_state *start,
                                                  hooke_system **system);
HOOKE_API void hooke_state_destroy(hooke_state *state);
HOOKE_API int32_t hooke_state_copy(const hooke_state *from, hooke_state *to);
HOOKE_API double hooke_state_time(const hooke_state *state);
HOOKE_API void hooke_state_set_time(hooke_state *state, double t);
HOOKE_API int64_t hooke_state_size(const hooke_state *state);
HOOKE_API double *hooke_state_position(const hooke_state *state);
HOOKE_API double *hooke_state_velocity(const hooke_state *state);
#ifdef __cplusplus
}
#endif
#endif
#ifndef HOOKE_INTEGRATOR_H
#define HOOKE_INTEGRATOR_H
#ifdef __cplusplus
extern "C" {
#endif
typedef struct hooke_integrator hooke_integrator;
typedef int32_t hooke_observer(int64_t step, const hooke_state *state, void *ctx);
typedef int32_t hooke_progress(double done, const char *what, void *ctx);
HOOKE_API int64_t hooke_method_count(void);
HOOKE_API const char *hooke_method_name(int64_t method);
HOOKE_API const char *hooke_method_meant(const char *word);
HOOKE_API const char *hooke_method_summary(const char *name);
HOOKE_API int32_t hooke_method_is_adaptive(const char *name);
HOOKE_API int32_t hooke_method_is_built(const char *name);
HOOKE_API int32_t hooke_method_is_suited(const char *name, const char *problem);
HOOKE_API int32_t hooke_integrator_create(const hooke_system *system, const hooke_options *options,
                                          hooke_integrator **integrator);
HOOKE_API int32_t hooke_integrator_create_first_order(int64_t size, hooke_rate *rate, void *ctx,
                                                      const hooke_options *options,
                                                      hooke_integrator **integrator);
HOOKE_API int32_t hooke_integrator_create_second_order(int64_t size, hooke_force *force,
                                                       hooke_force_product *product, void *ctx,
                                                       int64_t mass_count, const double *inverse_mass,
                                                       const hooke_options *options,
                                                       hooke_integrator **integrator);
HOOKE_API void hooke_integrator_destroy(hooke_integrator *integrator);
HOOKE_API const hooke_options *hooke_integrator_options(const hooke_integrator *integrator);
HOOKE_API int32_t hooke_integrator_on_frame(hooke_integrator *integrator, hooke_observer *observer,
                                            void *ctx);
HOOKE_API int32_t hooke_integrator_on_step(hooke_integrator *integrator, int64_t stride,
                                           hooke_observer *observer, void *ctx);
HOOKE_API int32_t hooke_integrator_on_checkpoint(hooke_integrator *integrator, hooke_observer *observer,
                                                 void *ctx);
HOOKE_API int32_t hooke_integrator_on_progress(hooke_integrator *integrator, double seconds,
                                               hooke_progress *progress, void *ctx);
HOOKE_API int32_t hooke_integrator_run(hooke_integrator *integrator, hooke_state *state);
HOOKE_API int32_t hooke_integrator_resume(hooke_integrator *integrator, hooke_state *state);
HOOKE_API int32_t hooke_integrator_step(hooke_integrator *integrator, hooke_state *state, int64_t steps);
HOOKE_API int32_t hooke_integrator_begin(hooke_integrator *integrator, hooke_state *state, double t0,
                                         int64_t step);
HOOKE_API int32_t hooke_integrator_advance(hooke_integrator *integrator, int64_t steps);
HOOKE_API int32_t hooke_integrator_sync(hooke_integrator *integrator, hooke_state *state);
HOOKE_API int32_t hooke_integrator_get(hooke_integrator *integrator, int64_t count, const int64_t *particles,
                                       double *q, double *v);
HOOKE_API int32_t hooke_integrator_put(hooke_integrator *integrator, int64_t count, const int64_t *particles,
                                       const double *q, const double *v);
HOOKE_API int64_t hooke_integrator_count(const hooke_integrator *integrator, const char *what);
HOOKE_API double hooke_integrator_number(const hooke_integrator *integrator, const char *what);
HOOKE_API const char *hooke_integrator_text(const hooke_integrator *integrator, const char *what);
HOOKE_API int32_t hooke_integrator_recent(const hooke_integrator *integrator, int64_t place,
                                          hooke_state *state);
typedef int32_t hooke_warning(const char *kind, const char *sentence, double t, double limit, int64_t spring,
                              int64_t particle, void *ctx);
HOOKE_API int32_t hooke_system_warnings(const hooke_system *system, hooke_warning *warning, void *ctx);
HOOKE_API int32_t hooke_integrator_on_warning(hooke_integrator *integrator, hooke_warning *warning,
                                              void *ctx);
#ifdef __cplusplus
}
#endif
#endif
#ifndef HOOKE_MEASUREMENT_H
#define HOOKE_MEASUREMENT_H
#ifdef __cplusplus
extern "C" {
#endif
typedef struct hooke_measurement hooke_measurement;
HOOKE_API int32_t hooke_measurement_create(const char *kind, const hooke_system *system,
                                           const hooke_options *run, const hooke_options *options,
                                           hooke_measurement **measurement);
HOOKE_API void hooke_measurement_destroy(hooke_measurement *measurement);
HOOKE_API const char *hooke_measurement_kind(const hooke_measurement *measurement);
HOOKE_API void hooke_measurement_on_progress(hooke_measurement *measurement, hooke_progress *progress,
                                             void *ctx);
HOOKE_API int32_t hooke_measurement_run(hooke_measurement *measurement, hooke_state *state);
HOOKE_API const char *hooke_measurement_table(const char *kind, int64_t table, const char *what);
HOOKE_API const char *hooke_measurement_column(const char *kind, const char *table, int64_t column,
                                               const char *what);
HOOKE_API const char *hooke_measurement_unit(const hooke_measurement *measurement, const char *table,
                                             const char *column);
HOOKE_API int64_t hooke_measurement_row_count(const hooke_measurement *measurement, const char *table);
HOOKE_API int64_t hooke_measurement_find(const hooke_measurement *measurement, const char *table,
                                         const char *column, const char *text);
HOOKE_API double hooke_measurement_number(const hooke_measurement *measurement, const char *table,
                                          int64_t row, const char *column);
HOOKE_API const char *hooke_measurement_text(const hooke_measurement *measurement, const char *table,
                                             int64_t row, const char *column);
HOOKE_API const double *hooke_measurement_series(const hooke_measurement *measurement, const char *table,
                                                 int64_t row, const char *column, int64_t *count);
HOOKE_API int32_t hooke_measurement_label(hooke_measurement *measurement, const char *what, const char *text);
HOOKE_API const char *hooke_measurement_json(hooke_measurement *measurement, const char *table, int64_t row);
HOOKE_API int32_t hooke_measurement_write(const hooke_measurement *measurement, const char *path);
HOOKE_API int32_t hooke_study_recommend(hooke_measurement *study, double want);
HOOKE_API double hooke_limit_of_mode(const char *method, double frequency, double decay);
HOOKE_API const hooke_system *hooke_needs_lean(const hooke_measurement *needs);
HOOKE_API const hooke_options *hooke_needs_lean_run(const hooke_measurement *needs);
HOOKE_API int64_t hooke_needs_lean_particle(const hooke_measurement *needs, int64_t particle);
HOOKE_API int32_t hooke_needs_lean_position(const hooke_measurement *needs, const double *q,
                                            double *position);
HOOKE_API int32_t hooke_why_create(const hooke_integrator *integrator, const hooke_options *options,
                                   hooke_measurement **measurement);
HOOKE_API int32_t hooke_why_create_kept(const hooke_system *system, const hooke_options *run,
                                        const hooke_state *first, const hooke_state *last,
                                        const hooke_options *options, hooke_measurement **measurement);
HOOKE_API int32_t hooke_why_advice_apply(const hooke_measurement *measurement, int64_t row,
                                         hooke_options *run);
HOOKE_API int32_t hooke_verify_create(const char *path, const hooke_options *options,
                                      const hooke_options *limits, hooke_measurement **verify);
HOOKE_API int32_t hooke_verify_create_with(const char *path, const hooke_system *system,
                                           const hooke_options *options, hooke_measurement **verify);
HOOKE_API int32_t hooke_step_bound(const hooke_system *system, const char *method, const double *q,
                                   double *bound);
HOOKE_API int32_t hooke_step_settle(const hooke_system *system, hooke_options *run);
HOOKE_API int32_t hooke_step_fit(const hooke_system *system, const double *q, hooke_options *run,
                                 hooke_warning *told, void *ctx);
#ifdef __cplusplus
}
#endif
#endif
#ifndef HOOKE_ESTIMATE_H
#define HOOKE_ESTIMATE_H
#ifdef __cplusplus
extern "C" {
#endif
HOOKE_API int32_t hooke_estimate_pick(hooke_measurement *estimate, const char *method, hooke_options *run);
HOOKE_API int32_t hooke_estimate_begin(hooke_measurement *estimate, const hooke_integrator *integrator,
                                       const hooke_state *state);
HOOKE_API int32_t hooke_estimate_see(int64_t step, const hooke_state *state, void *estimate);
HOOKE_API int32_t hooke_estimate_follow(hooke_measurement *estimate, hooke_integrator *integrator);
HOOKE_API int32_t hooke_estimate_refine(hooke_measurement *estimate, hooke_options *run);
HOOKE_API int32_t hooke_estimate_write_h5(const hooke_measurement *estimate, const char *path);
#ifdef __cplusplus
}
#endif
#endif
#ifndef HOOKE_SCENE_H
#define HOOKE_SCENE_H
#ifdef __cplusplus
extern "C" {
#endif
typedef struct hooke_scene hooke_scene;
HOOKE_API int32_t hooke_scene_load(const char *path, const hooke_options *limits, hooke_scene **scene);
HOOKE_API int32_t hooke_scene_parse(const char *text, int64_t length, const char *name, const char *folder,
                                    const hooke_options *limits, hooke_scene **scene);
HOOKE_API int32_t hooke_scene_commit(hooke_scene *scene);
HOOKE_API int32_t hooke_scene_options_apply(const hooke_options *options, hooke_system *system);
HOOKE_API int32_t hooke_system_add_members(hooke_system *system, const char *key, const char *name,
                                           int64_t count, const int64_t *particles,
                                           const hooke_options *options);
HOOKE_API int32_t hooke_scene_write(const char *path, const hooke_system *system, const char *title,
                                    const hooke_options *run);
HOOKE_API int32_t hooke_scene_of_system(const hooke_system *system, const char *title,
                                        const hooke_options *run, const char *name, const char *folder,
                                        hooke_scene **scene);
HOOKE_API int32_t hooke_scene_of_state(const hooke_system *system, const hooke_state *state,
                                       const char *title, const hooke_options *run, const char *name,
                                       const char *folder, hooke_scene **scene);
HOOKE_API int32_t hooke_scene_check_output(const hooke_scene *scene, const char *path);
HOOKE_API void hooke_scene_destroy(hooke_scene *scene);
HOOKE_API hooke_system *hooke_scene_system(hooke_scene *scene);
HOOKE_API hooke_options *hooke_scene_run_options(hooke_scene *scene);
HOOKE_API const char *hooke_scene_text(const hooke_scene *scene, const char *what);
HOOKE_API int32_t hooke_mesh_read(const char *path, hooke_options *options);
#ifdef __cplusplus
}
#endif
#endif
#ifndef HOOKE_TRAJECTORY_H
#define HOOKE_TRAJECTORY_H
#ifdef __cplusplus
extern "C" {
#endif
HOOKE_API int32_t hooke_io_own_process(void);
typedef struct hooke_trajectory hooke_trajectory;
HOOKE_API int32_t hooke_trajectory_create(const char *path, const hooke_system *system,
                                          const hooke_integrator *integrator, const char *scene_text,
                                          hooke_trajectory **trajectory);
HOOKE_API int32_t hooke_trajectory_write(hooke_trajectory *trajectory, int64_t step,
                                         const hooke_state *state);
HOOKE_API int32_t hooke_trajectory_write_behind(hooke_trajectory *trajectory);
HOOKE_API int32_t hooke_trajectory_mark_diverged(hooke_trajectory *trajectory);
HOOKE_API int32_t hooke_trajectory_sync(hooke_trajectory *trajectory);
HOOKE_API const char *hooke_trajectory_text(const hooke_trajectory *trajectory, const char *what);
HOOKE_API int32_t hooke_trajectory_close(hooke_trajectory *trajectory, int32_t outcome);
typedef struct hooke_probes hooke_probes;
HOOKE_API int32_t hooke_probes_create(hooke_integrator *integrator, const hooke_options *options,
                                      const char *path, hooke_probes **probes);
HOOKE_API double hooke_probes_number(const hooke_probes *probes, const char *what);
HOOKE_API int32_t hooke_probes_close(hooke_probes *probes);
typedef struct hooke_record hooke_record;
HOOKE_API int32_t hooke_record_open(const char *path, hooke_record **record);
HOOKE_API void hooke_record_close(hooke_record *record);
HOOKE_API const char *hooke_record_text(const hooke_record *record, const char *what);
HOOKE_API const hooke_options *hooke_record_options(const hooke_record *record);
HOOKE_API int64_t hooke_record_count(const hooke_record *record, const char *what);
HOOKE_API int32_t hooke_record_read(const hooke_record *record, int64_t frame, hooke_state *state);
HOOKE_API int32_t hooke_record_check(const hooke_record *record, int64_t frame);
HOOKE_API int32_t hooke_record_size(hooke_record *record, const char *what, int64_t *rows, int64_t *columns);
HOOKE_API int32_t hooke_record_numbers(hooke_record *record, const char *what, double *values);
HOOKE_API int64_t hooke_record_place(const hooke_record *record, const char *what);
HOOKE_API int32_t hooke_view_create(const hooke_record *record, const hooke_options *options,
                                    hooke_measurement **view);
HOOKE_API int32_t hooke_view_add(hooke_measurement *view, const hooke_measurement *other);
HOOKE_API int32_t hooke_record_write_xdmf(const hooke_record *record, const char *path);
#ifdef __cplusplus
}
#endif
#endif
#ifndef HOOKE_CHECKPOINT_H
#define HOOKE_CHECKPOINT_H
#ifdef __cplusplus
extern "C" {
#endif
HOOKE_API int32_t hooke_checkpoint_write(const char *path, const hooke_integrator *integrator,
                                         const hooke_state *state, const char *run);
HOOKE_API int32_t hooke_checkpoint_read(const char *path, const char *run, hooke_integrator *integrator,
                                        hooke_state *state);
HOOKE_API int32_t hooke_trajectory_checkpoint(hooke_trajectory *trajectory,
                                              const hooke_integrator *integrator, const hooke_state *state);
HOOKE_API int32_t hooke_trajectory_resume(const char *path, const hooke_system *system,
                                          hooke_integrator *integrator, hooke_state *state,
                                          hooke_trajectory **trajectory);
#ifdef __cplusplus
}
#endif
#endif
