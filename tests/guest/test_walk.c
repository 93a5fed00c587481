/* Every public function with odd arguments of every kind: NULL, sizes that are no sizes or overflow, numbers
 * that are none, states of another size and kind, and in builds that check handles, objects of another type.
 * Each call answers what its header says, reads nothing beyond an array, leaves no old object where it could
 * make none, and comes back. The functions are those of the headers. */
#include "check.h"
#include "public_calls.h"
#include "random.h"
#include "sanitized.h"

#include <limits.h>
#include <math.h>
#include <signal.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/mman.h>
#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>

/* What a header leaves undefined, and what is asked for takes as long as that does. */
static const struct {
  const char *function, *parameter, *why;
} left_out_here[] = {
    {"hooke_scene_parse", "length", "the text is as long as the caller says"},
    {"hooke_measurement_run", "state", "the walk of a measurement is a run of it: one of each"},
};

enum { MIXED = 40, SECONDS = 60 };

/* What the child does, for the parent to read when it has ended. */
static struct told {
  char call[400], wrong[600];
  int64_t calls, refused;
} * told;

/* ---- one call ---- */

static const char *odd(const struct parameter *p, int32_t choice, const union value *argument, char *text,
                       size_t size) {
  if (p->kind <= WHOLE)
    snprintf(text, size, "%lld", (long long)argument->whole);
  else if (p->kind == NUMBER)
    snprintf(text, size, "%g", argument->number);
  else if (p->kind == TEXT)
    snprintf(text, size, "%.20s", argument->constant ? (const char *)argument->constant : "NULL");
  else
    snprintf(text, size, "%s", argument->address == NULL ? "NULL" : choice ? "odd" : "good");
  return text;
}

static void tell_call(const struct function *f, const int32_t *choice, const union value *argument) {
  char text[64];
  size_t used = (size_t)snprintf(told->call, sizeof told->call, "%s(", f->name);
  for (int32_t k = 0; k < f->count && used < sizeof told->call - 80; k++)
    used += (size_t)snprintf(told->call + used, sizeof told->call - used, "%s%s #%d %s", k ? ", " : "",
                             f->parameter[k].name, (int)choice[k],
                             odd(&f->parameter[k], choice[k], &argument[k], text, sizeof text));
}

static void complain(const char *what, int64_t status) {
  if (told->wrong[0]) return;
  snprintf(told->wrong, sizeof told->wrong, "%s: %lld (%.150s) from %.300s", what, (long long)status,
           hooke_last_error(), told->call);
}

static char left_over; /* its address stands for an old object where a function puts a new one */

/* `bad`: 1 if something is missing that has to be there, or does not fit. */
static void check_result(const struct function *f, const union value *result, void *const *made, int bad) {
  const int64_t status = (int32_t)result->whole;
  if (!f->is_status) return;
  if (status < HOOKE_SOLVER_FAILED || status > HOOKE_STEP_LIMIT) complain("no status", status);
  if (status != HOOKE_OK && hooke_last_error()[0] == '\0') complain("no message", status);
  if (bad && status != HOOKE_BAD_VALUE && status != HOOKE_BAD_CALL && status != HOOKE_NOT_BUILT &&
      status != HOOKE_UNSUITED)
    complain("it is taken", status);
  for (int32_t k = 0; k < f->count; k++) {
    if (f->parameter[k].kind != MADE || made[k] == NULL) continue;
    if (made[k] == &left_over) {
      complain("an output is left as it was", status);
      continue;
    }
    if (status < 0) complain("an object besides a failure", status);
    destroy_object(f->parameter[k].type, made[k]);
  }
}

/* Of a call in which the handle `p` alone is bad, which the result and the message say. */
static void check_refusal(const struct function *f, const struct parameter *p, const union value *result) {
  const char *message = hooke_last_error();
  const size_t length = strlen(p->name);
  told->refused++;
  if (memcmp(result, &f->refusal, sizeof *result) != 0) complain("a bad handle is taken", result->whole);
  if (strncmp(message, p->name, length) != 0 || message[length] != ':' || strstr(message, p->type) == NULL ||
      strstr(message, f->name) == NULL)
    complain("the message is not of the handle", result->whole);
}

static int is_left_out(const struct function *f, int32_t place, int32_t choice) {
  const struct parameter *p = &f->parameter[place];
  /* an object of the pool would be gone; what a function makes is destroyed by these, too */
  const char *end = strrchr(f->name, '_');
  const int destroys = strcmp(end, "_destroy") == 0 || strcmp(end, "_close") == 0;
  if (destroys && p->kind == HANDLE && choice != 1) return 1;
  /* no array but those of a call of a force may be held */
  if (strcmp(f->name, "hooke_rows_hold") == 0 && p->kind == NUMBERS && choice != 1) return 1;
  for (size_t k = 0; k < sizeof left_out_here / sizeof left_out_here[0]; k++)
    if (strcmp(f->name, left_out_here[k].function) == 0 && strcmp(p->name, left_out_here[k].parameter) == 0)
      return choice > 1;
  return 0;
}

static void call(const struct pool *pool, const struct function *f, const int32_t *choice) {
  union value argument[MOST_PARAMETERS] = {{0}}, result = {.whole = 0};
  void *made[MOST_PARAMETERS] = {NULL};
  int bad = 0, objects = 0, odd_ones = 0, misfits = 0, missing = 0;
  const struct parameter *bad_handle = NULL;
  for (int32_t k = 0; k < f->count; k++) {
    const struct parameter *p = &f->parameter[k];
    if (is_left_out(f, k, choice[k])) return;
    choose(pool, f, k, choice[k], &made[k], &argument[k]);
    if (p->kind == MADE && argument[k].address) made[k] = &left_over;
    objects += p->kind == HANDLE && strcmp(p->type, "hooke_options") != 0;
    odd_ones += choice[k] != 0;
    misfits += is_misfit(pool, p, choice[k]);
    if (is_bad_handle(p, choice[k]))
      bad_handle = p;
    else
      missing += p->kind == HANDLE && !p->may_be_null && argument[k].address == NULL;
    const int pointer = p->kind != SHORT && p->kind != WHOLE && p->kind != NUMBER && p->kind != ADDRESS;
    /* an array may be missing where its count is 0 */
    const int of_count = p->kind == NUMBERS || p->kind == WHOLES;
    if (pointer && !of_count && choice[k] == 1 && argument[k].address == NULL && !p->may_be_null) bad = 1;
  }
  bad |= objects > 1 && misfits == 1 && odd_ones == 1;
  tell_call(f, choice, argument);
  told->calls++;
  hooke_options_create("no such kind", &(hooke_options *){NULL}); /* another message */
  f->call(argument, &result);
  if (bad_handle && odd_ones == 1 && !missing) check_refusal(f, bad_handle, &result);
  check_result(f, &result, made, bad);
}

/* ---- all calls of a function, in a process of its own ---- */

static struct pool pool;

static void walk(const struct function *f) {
  struct random_source random = {.state = 7};
  int32_t choice[MOST_PARAMETERS] = {0};
  for (int32_t k = 0; k < f->count; k++)
    if (strcmp(f->parameter[k].type, "hooke_trajectory") == 0) pool_add_trajectory(&pool);
  call(&pool, f, choice);
  for (int32_t k = 0; k < f->count; k++) {
    for (choice[k] = choices_of(&pool, &f->parameter[k]) - 1; choice[k] > 0; choice[k]--)
      call(&pool, f, choice);
  }
  for (int32_t n = 0; n < MIXED; n++) {
    for (int32_t k = 0; k < f->count; k++)
      choice[k] = random_whole(&random, 0, 2)
                      ? (int32_t)random_whole(&random, 0, choices_of(&pool, &f->parameter[k]) - 1)
                      : 0;
    call(&pool, f, choice);
  }
}

/* A size that a machine with much memory can hold is refused here, by the system or by the sanitizer. */
static void limit_memory(void) {
  const struct rlimit limit = {INT64_C(1) << 32, INT64_C(1) << 32};
  if (!HOOKE_SANITIZED) setrlimit(RLIMIT_AS, &limit);
}

const char *__asan_default_options(void);
const char *__asan_default_options(void) {
  return "allocator_may_return_null=1:max_allocation_size_mb=2000";
}

static void walk_apart(const struct function *f) {
  told->call[0] = told->wrong[0] = '\0';
  int end;
  const pid_t child = fork();
  if (child == 0) {
    signal(SIGSEGV, SIG_DFL); /* cmocka would go on with its next test */
    signal(SIGBUS, SIG_DFL);
    limit_memory();
    alarm(SECONDS);
    walk(f);
    _exit(0);
  }
  assert_true(child > 0 && waitpid(child, &end, 0) == child);
  if (WIFSIGNALED(end)) check_failed("signal %d in %s", WTERMSIG(end), told->call);
  if (WEXITSTATUS(end)) check_failed("exit %d in %s", WEXITSTATUS(end), told->call);
  if (told->wrong[0]) check_failed("%s", told->wrong);
}

TEST(test_every_function) {
  const char *only = getenv("HOOKE_WALK_ONLY");
  pool_begin(&pool);
  for (int32_t k = 0; k < public_function_count; k++)
    if (only == NULL || strstr(public_functions[k].name, only)) walk_apart(&public_functions[k]);
  pool_end(&pool);
  if (only == NULL) assert_true(public_function_count > 150 && told->calls > 8000);
  if (only == NULL) assert_true(told->refused > (HOOKE_CHECK_HANDLES ? 450 : 120));
  print_message("%lld calls of %d functions, %lld of them with a bad handle\n", (long long)told->calls,
                (int)public_function_count, (long long)told->refused);
}

/* Every function with objects that are gone, each in its turn. */
TEST(test_destroyed_objects) {
  if (!HOOKE_CHECK_HANDLES) skip();
  pool_begin(&pool);
  pool_add_trajectory(&pool);
  const struct pool gone = pool;
  pool_end(&pool);
  memset(told, 0, sizeof *told);
  for (int32_t k = 0; k < public_function_count; k++) {
    const struct function *f = &public_functions[k];
    union value argument[MOST_PARAMETERS] = {{0}}, result = {.whole = 0};
    const struct parameter *first = NULL;
    void *made[MOST_PARAMETERS] = {NULL};
    for (int32_t p = f->count - 1; p >= 0; p--) {
      choose(&gone, f, p, 0, &made[p], &argument[p]);
      if (f->parameter[p].kind == HANDLE && argument[p].address != NULL) first = &f->parameter[p];
    }
    if (first == NULL) continue;
    tell_call(f, (const int32_t[MOST_PARAMETERS]){0}, argument);
    f->call(argument, &result);
    check_refusal(f, first, &result);
    if (told->wrong[0]) check_failed("%s", told->wrong);
  }
  assert_true(told->refused > 120);
}

/* ---- a folder of its own ---- */

static char folder[] = "guest_walk_XXXXXX";

static int enter(void **unused) {
  (void)unused;
  FILE *shared = tmpfile();
  if (shared == NULL || ftruncate(fileno(shared), sizeof *told) != 0) return 1;
  told = mmap(NULL, sizeof *told, PROT_READ | PROT_WRITE, MAP_SHARED, fileno(shared), 0);
  return told == MAP_FAILED || mkdtemp(folder) == NULL || chdir(folder) != 0;
}

static int leave(void **unused) {
  (void)unused;
  char command[64];
  snprintf(command, sizeof command, "rm -r %s", folder);
  return chdir("..") != 0 || system(command) != 0;
}

AROUND_ALL(enter, leave)
