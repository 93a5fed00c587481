/* HDF5 allows one thread at a time unless it was built thread-safe, so hooke calls it from one: threads with
 * files of their own are never in it together. A replacement of H5Fopen() checks this. */
#include "check.h"
#include "run.h"
#include "small.h"

#include <pthread.h>
#include <stdatomic.h>
#include <stdio.h>
#include <time.h>

#if HOOKE_HAVE_HDF5

static atomic_int inside, most_inside;

int64_t __real_H5Fopen(const char *name, unsigned flags, int64_t list);
int64_t __wrap_H5Fopen(const char *name, unsigned flags, int64_t list);
int64_t __wrap_H5Fopen(const char *name, unsigned flags, int64_t list) {
  const int now = atomic_fetch_add(&inside, 1) + 1;
  if (now > most_inside) most_inside = now;
  nanosleep(&(struct timespec){.tv_nsec = 1000000}, NULL);
  const int64_t file = __real_H5Fopen(name, flags, list);
  atomic_fetch_sub(&inside, 1);
  return file;
}

enum { THREADS = 4, OPENINGS = 8 };
static pthread_barrier_t together;

struct reader {
  int number, fine_count;
  pthread_t thread;
};

static void *open_often(void *arg) {
  struct reader *reader = arg;
  char path[64];
  double time[1];
  int64_t rows, columns;
  snprintf(path, sizeof path, "unit_hdf5_alone_%d.h5", reader->number);
  pthread_barrier_wait(&together);
  for (int k = 0; k < OPENINGS; k++) {
    owned_record *record = NULL;
    if (hooke_record_open(path, &record) != HOOKE_OK) continue;
    const int fine = hooke_record_size(record, "time", &rows, &columns) == HOOKE_OK && rows == 1 &&
                     hooke_record_numbers(record, "time", time) == HOOKE_OK && time[0] == reader->number;
    reader->fine_count += fine;
  }
  return NULL;
}

TEST(test_files_at_once) {
  struct reader reader[THREADS];
  owned_system *system = small_oscillator(10.0);
  owned_run(integrator, state, system, .method = "verlet", .step = 0.125, .duration = 0.25);
  char path[64];
  for (int t = 0; t < THREADS; t++) {
    hooke_trajectory *trajectory;
    snprintf(path, sizeof path, "unit_hdf5_alone_%d.h5", t);
    hooke_state_set_time(state, t);
    check_ok(hooke_trajectory_create(path, system, integrator, NULL, &trajectory));
    check_ok(hooke_trajectory_write(trajectory, 0, state));
    check_ok(hooke_trajectory_close(trajectory, HOOKE_STOPPED));
  }
  pthread_barrier_init(&together, NULL, THREADS);
  for (int t = 0; t < THREADS; t++) {
    reader[t] = (struct reader){.number = t};
    assert_int_equal(pthread_create(&reader[t].thread, NULL, open_often, &reader[t]), 0);
  }
  for (int t = 0; t < THREADS; t++)
    pthread_join(reader[t].thread, NULL);
  pthread_barrier_destroy(&together);
  assert_int_equal(most_inside, 1);
  for (int t = 0; t < THREADS; t++) {
    snprintf(path, sizeof path, "unit_hdf5_alone_%d.h5", t);
    remove(path);
    assert_int_equal(reader[t].fine_count, OPENINGS);
  }
}

#else

TEST(test_files_at_once) {
  skip();
}

#endif
