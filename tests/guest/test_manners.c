/* The library leaves the state of the process unchanged: errno, rounding mode, treatment of denormals and
 * masks of exceptions, locale, mask and handlers of signals, working folder, file mode mask, open files,
 * threads. Checked after every call of every scenario of tests/fault, and of calls that fail. */
#define _GNU_SOURCE /* fegetexcept() */
#include "check.h"
#include "held.h"
#include "random_scene.h"
#include "run.h"
#include "sanitized.h"
#include "scenarios.h"
#include "small.h"

#include <errno.h>
#include <fcntl.h>
#include <fenv.h>
#include <locale.h>
#include <math.h>
#include <pthread.h>
#include <signal.h>
#include <stdio.h>
#include <string.h>
#include <sys/stat.h>
#include <unistd.h>
#if defined(__x86_64__)
#include <immintrin.h>
#endif

/* ---- the state of the process ---- */

enum { SENTINEL = 12345, SIGNALS = 32, PATH_ROOM = 512 };

struct manners {
  int error, rounding, traps, x87;
  unsigned control; /* of MXCSR: rounding, masks, denormals; not the flags */
  char locale[PATH_ROOM], folder[PATH_ROOM];
  locale_t threads_locale;
  sigset_t mask;
  void (*handler[SIGNALS])(int);
  mode_t modes;
  int64_t files, threads;
};

static void look(struct manners *m) {
  m->error = errno;
  m->rounding = fegetround();
  m->traps = fegetexcept();
#if defined(__x86_64__)
  unsigned short word;
  __asm__ __volatile__("fnstcw %0" : "=m"(word));
  m->x87 = word;
  m->control = _mm_getcsr() & ~0x3fU;
#endif
  snprintf(m->locale, sizeof m->locale, "%s", setlocale(LC_ALL, NULL));
  m->threads_locale = uselocale((locale_t)0);
  pthread_sigmask(SIG_BLOCK, NULL, &m->mask);
  for (int k = 1; k < SIGNALS; k++) {
    struct sigaction action;
    m->handler[k] = sigaction(k, NULL, &action) == 0 ? action.sa_handler : NULL;
  }
  if (getcwd(m->folder, sizeof m->folder) == NULL) m->folder[0] = '\0';
  m->modes = umask(022);
  umask(m->modes);
}

static void count_all(struct manners *m) {
  m->files = open_files();
  m->threads = thread_count();
}

static struct manners before, start;

static void arrive(void) {
  look(&before);
  errno = SENTINEL;
}

static int64_t complaints; /* all are printed before the test fails */

__attribute__((format(printf, 1, 2))) static void complain(const char *format, ...) {
  va_list args;
  va_start(args, format);
  char text[1024];
  vsnprintf(text, sizeof text, format, args);
  va_end(args);
  print_error("%s\n", text);
  complaints++;
}

static void leave(const char *call) {
  struct manners after;
  look(&after);
  if (after.error != SENTINEL)
    complain("%s\n  sets errno to %d (%s)", call, after.error, strerror(after.error));
  if (after.rounding != before.rounding || after.traps != before.traps || after.x87 != before.x87 ||
      after.control != before.control)
    complain("%s\n  changes the floating-point environment", call);
  if (strcmp(after.locale, before.locale) != 0 || after.threads_locale != before.threads_locale)
    complain("%s\n  changes the locale", call);
  for (int k = 1; k < SIGNALS; k++)
    if (after.handler[k] != before.handler[k] || sigismember(&after.mask, k) != sigismember(&before.mask, k))
      complain("%s\n  changes what becomes of signal %d", call, k);
  if (strcmp(after.folder, before.folder) != 0 || after.modes != before.modes)
    complain("%s\n  changes the working folder or the mask of modes", call);
}

static void leave_and_arrive(const char *call) {
  leave(call);
  arrive();
}

/* A call with an asserted result, or without one. */
#define OK(call)           REFUSED(call, HOOKE_OK)
#define REFUSED(call, yes) (arrive(), expect((call), (yes), #call))
#define ASK(call)          (arrive(), (void)(call), leave(#call))

static void expect(int32_t status, int32_t expected, const char *call) {
  leave(call);
  if (status != expected) complain("%s\n  returned %d (%s)", call, (int)status, hooke_last_error());
}

/* ---- the tour ---- */

static const char nowhere[] = "no/such/folder/file";
static char scenes[128]; /* folder of the scenarios */

static void tour_building(void) {
  hooke_system *system = NULL;
  hooke_options *springs = NULL, *rope = NULL, *none = NULL;
  hooke_state *none_such = NULL;
  const double q[] = {0, 0, 0, 1, 0, 0, 2, 0, 0}, mass[] = {1},
               far[] = {1e308, 1e308, 0, -1e308, 0, 0, 0, 0, 1};
  const int64_t ends[] = {0, 1, 1, 2}, triple[] = {0, 1, 2}, wrong[] = {0, 7};
  int64_t first;
  double bending = 1.0;
  OK(hooke_system_create(&system));
  OK(hooke_system_add_particles(system, 3, q, NULL, 1, mass, &first));
  OK(hooke_options_create("springs", &springs));
  OK(hooke_options_set_text(springs, "stiffness", "1e3"));
  REFUSED(hooke_options_set_text(springs, "stiffness", "1e999"), HOOKE_BAD_VALUE);
  REFUSED(hooke_options_set_text(springs, "stiffness", "1e-999"), HOOKE_BAD_VALUE);
  REFUSED(hooke_options_set_text(springs, "stifness", "1"), HOOKE_BAD_VALUE);
  REFUSED(hooke_options_set_number(springs, "stiffness", NAN), HOOKE_BAD_VALUE);
  OK(hooke_system_add_springs(system, "a", 2, ends, springs));
  REFUSED(hooke_system_add_springs(system, "b", 1, wrong, springs), HOOKE_BAD_VALUE);
  OK(hooke_system_add_bending(system, "c", 1, triple, 1, &bending));
  OK(hooke_options_create("rope", &rope));
  REFUSED(hooke_options_create("robe", &none), HOOKE_BAD_VALUE);
  REFUSED(hooke_system_add_part(system, "rope", NULL, rope, NULL, NULL), HOOKE_BAD_VALUE);
  REFUSED(hooke_mesh_set(rope, INT64_MAX / 64, q, 1, triple), HOOKE_BAD_VALUE);
  OK(hooke_system_commit(system));
  REFUSED(hooke_system_commit(system), HOOKE_BAD_CALL);
  ASK(hooke_system_energy(system, "total", far, far));
  ASK(hooke_system_count(system, "memory"));
  ASK(hooke_options_destroy(springs));
  ASK(hooke_options_destroy(rope));
  ASK(hooke_system_destroy(system));
  REFUSED(hooke_state_create_first_order(INT64_MAX, &none_such), HOOKE_BAD_VALUE);
  ASK(hooke_build_fact("instructions"));
  ASK(hooke_build_fact("licence"));
}

static void tour_methods(void) {
  struct random_scene scene;
  random_scene_with(&scene, .seed = 5, .particles = HOOKE_SANITIZED ? 200 : 700,
                    .springs = HOOKE_SANITIZED ? 500 : 2000, .features = SCENE_EVERYTHING);
  for (int64_t m = 0; m < 2 * hooke_method_count(); m++) {
    const char *method = hooke_method_name(m / 2);
    if (!hooke_method_is_built(method)) continue;
    owned_options *options = run_options((struct run){.method = method,
                                                      .step = 1e-3,
                                                      .duration = 4e-3,
                                                      .rtol = 1e-3,
                                                      .atol = 1e-3,
                                                      .threads = 1 + (int32_t)(m % 2)});
    owned_integrator *integrator = NULL;
    owned_state *state = NULL;
    OK(hooke_integrator_create(scene.system, options, &integrator));
    OK(hooke_state_create(scene.system, &state));
    OK(hooke_integrator_run(integrator, state));
    OK(hooke_integrator_step(integrator, state, 2));
    ASK(hooke_integrator_count(integrator, "steps"));
  }
  random_scene_destroy(&scene);
}

/* Files that are not there or cannot be. */
static void tour_nowhere(void) {
  owned_system *system = small_oscillator(100.0);
  owned_run(integrator, state, system, .method = "verlet", .step = 1e-3, .duration = 1.0);
  owned_measurement *study = NULL;
  hooke_trajectory *trajectory = NULL;
  hooke_record *record = NULL;
  hooke_scene *scene = NULL;
  const int32_t failed = hooke_build_fact("hdf5")[0] ? HOOKE_IO_FAILED : HOOKE_NOT_BUILT;
  REFUSED(hooke_trajectory_create(nowhere, system, integrator, NULL, &trajectory), failed);
  REFUSED(hooke_trajectory_create("/", system, integrator, NULL, &trajectory), failed);
  REFUSED(hooke_record_open(nowhere, &record), failed);
  OK(hooke_integrator_step(integrator, state, 2));
  REFUSED(hooke_checkpoint_write(nowhere, integrator, state, "run"), HOOKE_IO_FAILED);
  REFUSED(hooke_checkpoint_read(nowhere, "run", integrator, state), HOOKE_IO_FAILED);
  REFUSED(hooke_scene_write(nowhere, system, "title", NULL), HOOKE_IO_FAILED);
  REFUSED(hooke_scene_load(nowhere, NULL, &scene), HOOKE_BAD_VALUE);
  REFUSED(hooke_scene_load("/", NULL, &scene), HOOKE_BAD_VALUE);
  REFUSED(hooke_scene_parse("{\"hooke\": 1e999}", 16, "a", NULL, NULL, &scene), HOOKE_BAD_VALUE);
  owned_options *options = options_with("study", "methods=verlet once=1"),
                *run = options_with("run", "step=1e-3 duration=0.01");
  OK(hooke_measurement_create("study", system, run, options, &study));
  OK(hooke_measurement_run(study, NULL));
  REFUSED(hooke_measurement_write(study, "no/such/folder/file.csv"), HOOKE_IO_FAILED);
}

static void tour_scenarios(void) {
  const struct scenario *scenario;
  for (int32_t k = 0; (scenario = scenario_at(k)) != NULL; k++) {
    if (scenario->share > 20) continue;
    struct attempt a = scenario_attempt(scenes);
    a.after = leave_and_arrive;
    arrive();
    scenario->run(&a, scenario->with);
    leave(scenario->name);
  }
}

static void tour(void) {
  complaints = 0;
  tour_building();
  tour_methods();
  tour_nowhere();
  tour_scenarios();
  assert_int_equal(complaints, 0);
}

/* ---- in usual and unusual states ---- */

TEST(test_as_usual) {
  tour();
}

static void on_signal(int number) {
  (void)number;
}

/* Sets everything to non-default values. Results are not checked here: in another rounding mode they are the
 * caller's responsibility. */
TEST(test_in_odd_surroundings) {
  sigset_t mask, kept;
  sigemptyset(&mask);
  sigaddset(&mask, SIGUSR1);
  sigaddset(&mask, SIGTERM);
  pthread_sigmask(SIG_BLOCK, &mask, &kept);
  struct sigaction action = {.sa_handler = on_signal}, pipe_before, interrupt_before;
  sigaction(SIGPIPE, &action, &pipe_before);
  sigaction(SIGINT, &action, &interrupt_before);
  const mode_t modes = umask(077);
  fesetround(FE_UPWARD);
#if defined(__x86_64__)
  const unsigned control = _mm_getcsr();
  _mm_setcsr(control | 0x8040U); /* denormals are zero, as input and output */
#endif
  tour();
#if defined(__x86_64__)
  _mm_setcsr(control);
#endif
  fesetround(FE_TONEAREST);
  umask(modes);
  sigaction(SIGINT, &interrupt_before, NULL);
  sigaction(SIGPIPE, &pipe_before, NULL);
  pthread_sigmask(SIG_SETMASK, &kept, NULL);
}

/* The first tour may make libraries open files that they keep; a second one adds none. */
TEST(test_nothing_stays_open) {
  count_all(&start);
  if (start.files < 0) skip();
  tour();
  struct manners end;
  count_all(&end);
  assert_int_equal(end.files, start.files);
  assert_int_equal(end.threads, start.threads);
}

static int prepare(void **unused) {
  (void)unused;
  return open_folder(scenes);
}

static int clear(void **unused) {
  (void)unused;
  return close_folder(scenes);
}

AROUND_ALL(prepare, clear)
