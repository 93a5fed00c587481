#include "integrate/method.h"

#include "core/print.h"
#include "core/status.h"
#include "model/force/force.h"
#include "model/coordinates/coordinates.h"
#include "model/generalized.h"
#include "model/particles.h"

#include <string.h>

static const struct hk_method *const table[] = {
    &hk_forward_euler,
    &hk_symplectic_euler,
    &hk_verlet,
    &hk_shardlow,
    &hk_heun,
    &hk_rk4,
    &hk_backward_euler,
    &hk_tr_bdf2,
    &hk_implicit_midpoint,
    &hk_cvode_bdf,
    &hk_cvode_adams,
    &hk_rk8pd,
    &hk_arkode_esdirk,
};

enum { ROWS = sizeof table / sizeof table[0] };

int64_t hooke_method_count(void) {
  int64_t count = 0;
  for (int64_t k = 0; k < ROWS; k++)
    count += !table[k]->reference;
  return count;
}

const char *hooke_method_name(int64_t method) {
  if (method < 0) return NULL;
  for (int64_t k = 0; k < ROWS; k++) {
    if (!table[k]->reference && method-- == 0) return table[k]->name;
  }
  return NULL;
}

/* Other common names, after plain(); several methods where texts do not agree, or where only relatives are
 * there. */
static const struct {
  const char *word, *methods;
} common_names[] = {
    {"explicit-euler", "forward-euler"},
    {"semi-implicit-euler", "symplectic-euler"},
    {"implicit-euler", "backward-euler"},
    {"velocity-verlet", "verlet"},
    {"leapfrog", "verlet"},
    {"runge-kutta-4", "rk4"},
    {"euler", "forward-euler symplectic-euler backward-euler"},
    {"midpoint", "implicit-midpoint heun"}, /* the nearest to the explicit rule */
    {"trapezoidal", "implicit-midpoint tr-bdf2"},
    {"crank-nicolson", "implicit-midpoint tr-bdf2"},
    {"rk2", "heun rk4"},
    {"bdf", "cvode-bdf tr-bdf2"},
};

enum { WORD_SIZE = 32 };

/* Small letters, with a hyphen for a blank or an underscore; "" if it is too long to be a name. */
static const char *plain(const char *word, char text[WORD_SIZE]) {
  size_t length = 0;
  for (; word[length] && length + 1 < WORD_SIZE; length++) {
    const char c = word[length];
    text[length] = (char)(c >= 'A' && c <= 'Z' ? c - 'A' + 'a' : c == ' ' || c == '_' ? '-' : c);
  }
  text[word[length] ? 0 : length] = '\0';
  return text;
}

const char *hooke_method_meant(const char *word) {
  char text[WORD_SIZE];
  const struct hk_method *method = hk_method_find(plain(word, text));
  if (method) return method->name;
  for (size_t k = 0; k < sizeof common_names / sizeof common_names[0]; k++) {
    if (strcmp(common_names[k].word, text) == 0) return common_names[k].methods;
  }
  return "";
}

const struct hk_method *hk_method_find(const char *name) {
  for (int64_t k = 0; k < ROWS; k++) {
    if (strcmp(table[k]->name, name) == 0) return table[k];
  }
  return NULL;
}

const struct hk_stability *hk_method_stability(const char *name) {
  static const struct hk_stability unknown = {.kind = HOOKE_STABILITY_UNKNOWN};
  const struct hk_method *method = hk_method_find(name);
  return method ? &method->stability : &unknown;
}

const struct hk_stability *hk_method_stability_in(const char *name, const hooke_system *system) {
  const int32_t predicts =
      system->mover_count > 0 || system->explicit_damping || hk_system_is_not_linear(system);
  const struct hk_method *method = predicts ? hk_method_find(name) : NULL;
  const int own = method && method->with_bodies.kind != HOOKE_STABILITY_UNKNOWN;
  return own ? &method->with_bodies : hk_method_stability(name);
}

/* ---- what methods take ---- */

enum { SECOND_ORDER, BODIES, OVERDAMPED, FIRST_ORDER, PROBLEMS }; /* powers of 2: HOOKE_TAKES_* */

static const struct {
  const char *word, *refusal;
} problems[PROBLEMS] = {
    [SECOND_ORDER] = {"second-order", ""},
    [BODIES] = {"bodies", "does not know rigid bodies yet"},
    [OVERDAMPED] = {"overdamped",
                    "steps positions and velocities apart, and an overdamped scene has no such parts"},
    [FIRST_ORDER] = {"first-order",
                     "steps positions and velocities apart, and x' = phi(t, x) has no such parts"},
};

static int32_t takes(const struct hk_method *method, int problem) {
  return problem == SECOND_ORDER || method->takes >> problem & 1;
}

static int problem_of(const hooke_system *system) {
  if (system == NULL || hk_is_first_order(system)) return FIRST_ORDER;
  return system->mover_count > 0 ? BODIES : system->overdamped ? OVERDAMPED : SECOND_ORDER;
}

/* 1 if it would take dampers apart that are not linear. */
static int32_t splits(const struct hk_method *method, const hooke_system *system) {
  return system && method->stability.damps_apart && hk_system_is_not_linear(system);
}

static int32_t suits(const struct hk_method *method, const hooke_system *system) {
  if (!takes(method, problem_of(system)) || splits(method, system)) return 0;
  return system == NULL || !method->solved || hk_movers_are_solved(system);
}

int32_t hk_method_suits(const char *name, const hooke_system *system) {
  return suits(hk_method_find(name), system);
}

static void list_method(const struct hk_method *method, char *list, size_t size) {
  if (!method->reference) hk_append(list, size, "%s%s", list[0] ? ", " : "", method->name);
}

void hk_method_list(char *list, size_t size) {
  list[0] = '\0';
  for (int64_t k = 0; k < ROWS; k++)
    list_method(table[k], list, size);
}

int32_t hk_method_take(const char *name, const struct hk_method **method) {
  char names[256];
  *method = hk_method_find(name);
  if (*method && (*method)->steps) return HOOKE_OK;
  if (*method)
    return hk_fail(HOOKE_NOT_BUILT, "method", "%s needs %s, which this build is without", name,
                   (*method)->needs);
  hk_method_list(names, sizeof names);
  return hk_fail(HOOKE_BAD_VALUE, "method", "there is no method \"%s\"; allowed: %s", name, names);
}

int32_t hk_method_require(const struct hk_method *method, const hooke_system *system) {
  const int problem = problem_of(system);
  const int32_t solves = problem == FIRST_ORDER && method->solved;
  char list[512] = "";
  if (suits(method, system)) return HOOKE_OK;
  for (int64_t k = 0; k < ROWS; k++)
    if (table[k]->steps && suits(table[k], system)) list_method(table[k], list, sizeof list);
  return hk_fail(HOOKE_UNSUITED, "method", "%s %s; allowed: %s", method->name,
                 solves ? "solves its step with the derivative of the forces, and x' = phi(t, x) brings none"
                 : splits(method, system)
                     ? "takes dampers one by one, and some force is not linear in velocities"
                     : problems[problem].refusal,
                 list);
}

int32_t hooke_method_is_suited(const char *name, const char *problem) {
  const struct hk_method *method = hk_method_find(name);
  for (int k = 0; k < PROBLEMS && method; k++)
    if (strcmp(problems[k].word, problem) == 0) return takes(method, k);
  return -1;
}

const char *hk_method_of_euler(const hooke_system *system) {
  return system->overdamped ? hk_forward_euler.name : hk_symplectic_euler.name;
}

int32_t hk_method_needs_damping(const char *name) {
  const struct hk_stability *stability = hk_method_stability(name);
  return stability->kind == HOOKE_STABLE_BY_POLYNOMIAL && stability->axis == 0.0;
}

const char *hooke_method_summary(const char *name) {
  const struct hk_method *method = hk_method_find(name);
  return method ? method->summary : NULL;
}

int32_t hooke_method_is_adaptive(const char *name) {
  const struct hk_method *method = hk_method_find(name);
  return method ? method->adaptive : -1;
}

int32_t hooke_method_is_built(const char *name) {
  const struct hk_method *method = hk_method_find(name);
  return method && method->steps;
}
