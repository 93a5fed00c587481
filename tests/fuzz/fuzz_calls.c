/* Calls of the public functions in any order: with objects that earlier calls made, changed and destroyed,
 * and with arguments of every kind, good ones mostly. Each comes back with a status and a message, whatever
 * was called before.
 *
 * Two bytes select a function, one byte each argument.
 *
 * Lines of: include/hooke/base.h
 * Longest input: 2000 */
#include "fuzz.h"
#include "memory_folder.h"
#include "public_calls.h"

#include "hooke.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

enum { GOOD_OF_4 = 3 };

static int ends_in(const char *name, const char *end) {
  const size_t length = strlen(name), tail = strlen(end);
  return length > tail && strcmp(name + length - tail, end) == 0;
}

/* What others refer to lives as long as they do: by the headers that is the caller's affair. And no call
 * takes long, since all can be stopped. A text is as long as the caller says. */
static int is_left_out(const struct function *f) {
  const int frees = ends_in(f->name, "_destroy") || ends_in(f->name, "_close");
  const int alone =
      strcmp(f->name, "hooke_state_destroy") == 0 || strcmp(f->name, "hooke_options_destroy") == 0;
  return (frees && !alone) || ends_in(f->name, "_on_progress") || ends_in(f->name, "_own_process") ||
         ends_in(f->name, "scene_parse") || ends_in(f->name, "_rows_hold");
}

static void forget(struct pool *pool, const void *address) {
  for (int32_t k = 0; k < pool->count; k++)
    if (pool->object[k].address == address) pool->object[k--] = pool->object[--pool->count];
}

static void check_status(const struct function *f, int32_t status) {
  if (!f->is_status) return;
  hooke_fuzz_require(status >= HOOKE_SOLVER_FAILED && status <= HOOKE_STEP_LIMIT, "a status");
  if (status == HOOKE_OK) hooke_fuzz_is_accepted();
  if (status < 0) hooke_fuzz_require_lines(HOOKE_FUZZ_FAULTS);
}

/* The first system, options and states stay, which good arguments refer to. */
static int is_kept(const struct pool *pool, int32_t initial, const void *address) {
  for (int32_t k = 0; k < initial && k < pool->count; k++)
    if (pool->object[k].address == address) return 1;
  return 0;
}

static void call(struct pool *pool, int32_t initial, const struct function *f, const uint8_t *choice) {
  union value argument[MOST_PARAMETERS], result = {.whole = 0};
  void *made[MOST_PARAMETERS] = {NULL};
  const int frees = ends_in(f->name, "_destroy");
  for (int32_t k = 0; k < f->count; k++) {
    const struct parameter *p = &f->parameter[k];
    int32_t odd = choice[k] % 4 < GOOD_OF_4 ? 0 : choice[k] / 4 % choices_of(pool, p);
    /* this build is without the guard, which is what refuses NULL; tests/guest/test_walk.c tries that */
    if (odd == 1 && p->kind > NUMBER && !p->may_be_null) odd = 0;
    choose(pool, f, k, odd, &made[k], &argument[k]);
    const int none = p->kind == HANDLE && !p->may_be_null && argument[k].address == NULL;
    if (none) return;
    if (frees && is_kept(pool, initial, argument[k].address)) return;
  }
  f->call(argument, &result);
  if (frees) forget(pool, argument[0].address);
  check_status(f, (int32_t)result.whole);
  for (int32_t k = 0; k < f->count; k++) {
    if (made[k] == NULL || f->parameter[k].kind != MADE) continue;
    hooke_fuzz_require(!f->is_status || (int32_t)result.whole >= 0, "an object besides a failure");
    if (!pool_add(pool, f->parameter[k].type, NULL, made[k])) destroy_object(f->parameter[k].type, made[k]);
  }
}

static char folder[64];

static void remove_folder(void) {
  char command[80];
  snprintf(command, sizeof command, "rm -r %s", folder);
  if (system(command) != 0) fprintf(stderr, "%s is left\n", folder);
}

static void enter_folder(void) {
  if (folder[0]) return;
  snprintf(folder, sizeof folder, "%s/hooke-fuzz-XXXXXX", memory_folder());
  hooke_fuzz_require(mkdtemp(folder) != NULL && chdir(folder) == 0, "a folder");
  atexit(remove_folder);
}

int LLVMFuzzerTestOneInput(const uint8_t *data, size_t size) {
  static struct pool pool;
  hooke_fuzz_begin();
  enter_folder();
  pool_begin(&pool);
  const int32_t initial = pool.count;
  hooke_fuzz_is_past_syntax();
  while (size >= 2 + MOST_PARAMETERS) {
    const struct function *f = &public_functions[(data[0] + 256 * data[1]) % public_function_count];
    if (!is_left_out(f)) call(&pool, initial, f, data + 2);
    data += 2 + f->count;
    size -= 2 + (size_t)f->count;
  }
  pool_end(&pool);
  return 0;
}
