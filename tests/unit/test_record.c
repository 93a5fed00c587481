/* Trajectory files read as whole arrays, and the offsets of their frames. */
#include "check.h"
#include "hooke/trajectory.h"
#include "run.h"
#include "small.h"

#include <math.h>
#include <stdio.h>
#include <string.h>
#include <unistd.h>

enum { N = 12, SPRINGS = 17, FRAMES = 5, PATH_SIZE = 256 };

static hooke_system *cloth(void) {
  return small_falling(small_part(
      NULL, "cloth", NULL, "edges=1,0,0,0,0,1 size=4,3 pinned=top-corners mass=6 structural.stiffness=5"));
}

TEST(a_cloth_without_origin_begins_at_zero) {
  owned_system *system = cloth();
  owned_state *state = start_state(system);
  assert_memory_equal(hooke_state_position(state), ((double[]){0, 0, 0}), 3 * sizeof(double));
  assert_true(hooke_state_position(state)[9] == 1.0);
}

#if HOOKE_HAVE_HDF5

struct fixture {
  char folder[PATH_SIZE / 2], path[PATH_SIZE];
  hooke_system *system;
  double q[FRAMES][3 * N], v[FRAMES][3 * N], energy[FRAMES];
  hooke_record *record;
};

/* A run that stops after `frames` of its frames. */
static struct fixture record(int64_t frames) {
  struct fixture f = {.system = cloth()};
  snprintf(f.folder, sizeof f.folder, "%s/hooke-record-XXXXXX", P_tmpdir);
  assert_non_null(mkdtemp(f.folder));
  snprintf(f.path, sizeof f.path, "%s/out.h5", f.folder);
  hooke_integrator *integrator = start_run(
      f.system, (struct run){.method = "symplectic-euler", .step = 0.01, .duration = 0.04, .every = 0.01});
  hooke_state *state = start_state(f.system);
  hooke_trajectory *trajectory;
  check_ok(hooke_trajectory_create(f.path, f.system, integrator, NULL, &trajectory));
  for (int64_t k = 0; k < frames; k++) {
    if (k > 0) check_ok(hooke_integrator_step(integrator, state, 1));
    check_ok(hooke_trajectory_write(trajectory, k, state));
    memcpy(f.q[k], hooke_state_position(state), sizeof f.q[k]);
    memcpy(f.v[k], hooke_state_velocity(state), sizeof f.v[k]);
    f.energy[k] = hooke_system_energy(f.system, "kinetic", NULL, f.v[k]);
  }
  check_ok(hooke_trajectory_close(trajectory, frames == FRAMES ? HOOKE_OK : HOOKE_STOPPED));
  hooke_state_destroy(state);
  hooke_integrator_destroy(integrator);
  check_ok(hooke_record_open(f.path, &f.record));
  return f;
}

static void release(struct fixture *f) {
  hooke_record_close(f->record);
  hooke_system_destroy(f->system);
  unlink(f->path);
  assert_int_equal(rmdir(f->folder), 0);
}

static double *numbers(const struct fixture *f, const char *what, int64_t rows, int64_t columns) {
  int64_t size[2];
  check_ok(hooke_record_size(f->record, what, &size[0], &size[1]));
  assert_int_equal(size[0], rows);
  assert_int_equal(size[1], columns);
  double *values = new_block(rows * columns, sizeof *values);
  check_ok(hooke_record_numbers(f->record, what, values));
  return values;
}

TEST(arrays_are_those_of_the_run) {
  struct fixture f = record(FRAMES);
  double *time = numbers(&f, "time", FRAMES, 1), *step = numbers(&f, "step", FRAMES, 1);
  double *kinetic = numbers(&f, "kinetic_energy", FRAMES, 1), *momentum = numbers(&f, "momentum", FRAMES, 3);
  double *mass = numbers(&f, "mass", N, 1), *species = numbers(&f, "species", N, 1);
  double *springs = numbers(&f, "springs", SPRINGS, 2);
  for (int k = 0; k < FRAMES; k++) {
    double sum[3];
    hooke_system_momentum(f.system, f.v[k], sum);
    assert_true(step[k] == k && fabs(time[k] - 0.01 * k) < 1e-15 && kinetic[k] == f.energy[k]);
    assert_memory_equal(momentum + 3 * k, sum, sizeof sum);
  }
  int64_t ends[2 * SPRINGS];
  check_ok(hooke_system_members(f.system, "springs", ends, NULL, NULL, NULL));
  for (int k = 0; k < 2 * SPRINGS; k++)
    assert_true(springs[k] == (double)ends[k]);
  for (int k = 0; k < N; k++)
    assert_true(mass[k] == 0.5 && species[k] == (k == 0 || k == 3));
  double *const all[] = {time, step, kinetic, momentum, mass, species, springs};
  for (size_t k = 0; k < sizeof all / sizeof all[0]; k++)
    free(all[k]);
  release(&f);
}

/* For a finished run, and for one that was truncated to its frames. */
TEST(frames_lie_where_it_says) {
  const int64_t frames[] = {FRAMES, 3};
  for (int k = 0; k < 2; k++) {
    struct fixture f = record(frames[k]);
    double there[3 * N];
    FILE *file = fopen(f.path, "rb");
    assert_non_null(file);
    for (int64_t at = 0; at < frames[k]; at++) {
      for (int moving = 0; moving < 2; moving++) {
        const int64_t place = hooke_record_place(f.record, moving ? "velocity" : "position");
        assert_true(place > 0);
        assert_int_equal(fseek(file, (long)(place + at * (int64_t)sizeof there), SEEK_SET), 0);
        assert_int_equal(fread(there, sizeof there, 1, file), 1);
        assert_memory_equal(there, moving ? f.v[at] : f.q[at], sizeof there);
      }
    }
    assert_int_equal(hooke_record_place(f.record, "mass"), -1);
    fclose(file);
    release(&f);
  }
}

TEST(other_words_are_refused) {
  struct fixture f = record(1);
  int64_t rows = 7, columns = 7;
  double none;
  check_status(hooke_record_size(f.record, "colour", &rows, &columns), HOOKE_BAD_VALUE);
  check_message("a trajectory has no \"colour\"; allowed: time, step");
  assert_int_equal(rows + columns, 0);
  check_status(hooke_record_numbers(f.record, "position", &none), HOOKE_BAD_VALUE);
  unlink(f.path);
  check_status(hooke_record_size(f.record, "mass", &rows, &columns), HOOKE_IO_FAILED);
  release(&f);
}

#else

TEST(it_is_not_in_this_build) {
  int64_t rows = 7, columns = 7;
  double none;
  check_status(hooke_record_size(NULL, "mass", &rows, &columns), HOOKE_BAD_CALL); /* there can be no record */
  check_status(hooke_record_numbers(NULL, "mass", &none), HOOKE_BAD_CALL);
  assert_int_equal(hooke_record_place(NULL, "position"), -1);
}

#endif
