/* Cost of a step, for each spring of a scene, compared with a plain loop over an array of springs and with
 * the limits of the machine; docs/notes/performance.md says how to read it.
 *
 *   speed [--seconds S] [--methods M,...] [--threads N,...] [--csv | --markdown] [SCENE ...]
 *
 * S (2) is the time for the turns of each row [s]. By default it runs all scenes with symplectic Euler, and
 * some of them with other explicit methods. It returns 1 if the motions of the library and the plain loop
 * differ. */
#include "table.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>

enum { MOST_NAMES = 64 };

struct arguments {
  enum table_form form;
  struct race_request request;
  int name_count;
  const char *name[MOST_NAMES];
};

/* For scenes without damping; with it, steps of verlet are implicit. Forward Euler is stable at no step of
 * these scenes. */
static const char *const explicit_methods[] = {"symplectic-euler", "rk4", "verlet"};

static int read_methods(char *list, struct race_request *request) {
  for (char *word = strtok(list, ","); word; word = strtok(NULL, ",")) {
    if (request->method_count == MOST_METHODS || hooke_method_is_adaptive(word) != 0) {
      fprintf(stderr, "%s: not a method of a fixed step, or one too many\n", word);
      return 0;
    }
    request->method[request->method_count++] = word;
  }
  return request->method_count > 0;
}

static int read_threads(char *list, struct race_request *request) {
  request->thread_count = 0;
  for (char *word = strtok(list, ","); word; word = strtok(NULL, ",")) {
    const long threads = strtol(word, NULL, 10);
    if (request->thread_count == MOST_THREADS || threads < 1 || threads > 1024) {
      fprintf(stderr, "%s: not a number of threads, or one too many\n", word);
      return 0;
    }
    request->threads[request->thread_count++] = (int32_t)threads;
  }
  return request->thread_count > 0;
}

static int is_scene(const char *name) {
  for (int64_t k = 0; bench_scene(k); k++) {
    if (strcmp(bench_scene(k)->name, name) == 0) return 1;
  }
  fprintf(stderr, "%s: no such scene; there are", name);
  for (int64_t k = 0; bench_scene(k); k++)
    fprintf(stderr, " %s", bench_scene(k)->name);
  fprintf(stderr, "\n");
  return 0;
}

static int read_arguments(int argc, char **argv, struct arguments *a) {
  int fits = 1;
  *a = (struct arguments){.form = TABLE_TEXT, .request = {.seconds = 2.0, .thread_count = 1, .threads = {1}}};
  for (int k = 1; k < argc && fits; k++) {
    const int more = k + 1 < argc;
    if (strcmp(argv[k], "--csv") == 0)
      a->form = TABLE_CSV;
    else if (strcmp(argv[k], "--markdown") == 0)
      a->form = TABLE_MARKDOWN;
    else if (strcmp(argv[k], "--seconds") == 0 && more)
      fits = (a->request.seconds = strtod(argv[++k], NULL)) > 0.0;
    else if (strcmp(argv[k], "--threads") == 0 && more)
      fits = read_threads(argv[++k], &a->request);
    else if (strcmp(argv[k], "--methods") == 0 && more)
      fits = read_methods(argv[++k], &a->request);
    else if (argv[k][0] != '-' && a->name_count < MOST_NAMES && is_scene(argv[k]))
      a->name[a->name_count++] = argv[k];
    else
      fits = 0;
  }
  return fits;
}

static int is_wanted(const struct arguments *a, const char *name) {
  int wanted = a->name_count == 0;
  for (int k = 0; k < a->name_count; k++)
    wanted |= strcmp(a->name[k], name) == 0;
  return wanted;
}

/* The methods that a scene is run with. */
static struct race_request request_of(const struct arguments *a, const struct bench_scene *scene) {
  struct race_request request = a->request;
  if (request.method_count > 0) return request;
  request.method_count = !scene->has_more ? 1 : scene->damping > 0.0 ? 2 : 3;
  memcpy(request.method, explicit_methods, sizeof explicit_methods);
  return request;
}

/* Runs a scene and prints its rows; 1 if that succeeded and all motions agreed. */
static int show(const struct arguments *a, const struct bench_scene *scene, const struct machine *machine,
                const struct limits *limits) {
  const struct race_request request = request_of(a, scene);
  struct race_row row[MOST_ROWS];
  int count, alike = 1;
  const int32_t status = race_run(scene, &request, row, &count);
  if (status != HOOKE_OK) {
    fprintf(stderr, "%s: %s: %s\n", scene->name, hooke_status_name(status), hooke_last_error());
    return 0;
  }
  if (count < request.method_count * request.thread_count) {
    fprintf(stderr, "%s: without the methods that are stable at no step\n", scene->name);
  }
  for (int k = 0; k < count; k++) {
    table_row(a->form, machine, &row[k], &limits[k % request.thread_count]);
    if (!(row[k].distance > row[k].allowed)) continue;
    fprintf(stderr, "%s, %s, %d threads: the plain loop is %.3g m away, and rounding explains %.3g m\n",
            scene->name, row[k].method, (int)row[k].threads, row[k].distance, row[k].allowed);
    alike = 0;
  }
  return alike;
}

int main(int argc, char **argv) {
  struct arguments arguments;
  struct machine machine;
  struct limits limits[MOST_THREADS];
  int fine = 1;
  if (!read_arguments(argc, argv, &arguments)) {
    fprintf(stderr,
            "speed [--seconds S] [--methods M,...] [--threads N,...] [--csv | --markdown] [SCENE ...]\n");
    return 2;
  }
  machine_read(&machine);
  for (int k = 0; k < arguments.request.thread_count; k++) {
    if (limits_measure(arguments.request.threads[k], &limits[k])) continue;
    fprintf(stderr, "no memory or threads to measure the machine\n");
    return 1;
  }
  table_begin(arguments.form, &machine, &arguments.request, limits);
  for (int64_t k = 0; bench_scene(k); k++) {
    if (is_wanted(&arguments, bench_scene(k)->name))
      fine &= show(&arguments, bench_scene(k), &machine, limits);
  }
  return fine ? 0 : 1;
}
