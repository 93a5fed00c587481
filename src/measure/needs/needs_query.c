/* Reading what was found. */
#include "measure/needs/needs.h"

#include "core/figure.h"
#include "core/status.h"

#include <math.h>
#include <string.h>

/* The words that full system, rows and lean system have in common. */
static double cost_number(const struct hk_needs_cost *cost, const char *what) {
  const struct hk_figure figures[] = {
      {"particles", cost->particles},
      {"springs", cost->springs},
      {"step_limit", cost->step_limit},
      {"step", cost->step},
      {"rtol", cost->rtol},
      {"atol", cost->atol},
      {"steps", cost->steps},
      {"force_evaluations", cost->force_evaluations},
      {"wall_seconds", cost->wall_seconds},
      {"step_error", cost->step_error},
  };
  return HOOKE_FIGURE(figures, what);
}

double hooke_needs_figure(const hooke_needs *needs, const char *what) {
  const struct hk_figure figures[] = {
      {"want", needs->want},
      {"method_picked", (double)needs->method_picked},
      {"runs", (double)needs->runs},
      {"duration", needs->duration},
      {"judged_until", (double)(needs->judged - 1) * needs->every},
      {"lean_error", needs->lean_error},
      {"cheapest_error", needs->cheapest_error},
      {"other_seconds", needs->other_seconds},
      {"times_less",
       needs->lean ? needs->cheapest.wall_seconds / needs->lean_cost.wall_seconds : (double)NAN},
  };
  const double value = HOOKE_FIGURE(figures, what);
  if (!isnan(value)) return value;
  if (strncmp(what, "lean_", 5) == 0)
    return needs->lean ? cost_number(&needs->lean_cost, what + 5) : (double)NAN;
  if (strncmp(what, "cheapest_", 9) == 0)
    return needs->lean ? cost_number(&needs->cheapest, what + 9) : (double)NAN;
  if (needs->path.position == NULL) return NAN;
  if (strcmp(what, "own_error") == 0) return needs->own_error;
  return strcmp(what, "moved") == 0 ? needs->moved : cost_number(&needs->full, what);
}

const char *hooke_needs_word(const hooke_needs *needs, const char *what) {
  if (strcmp(what, "other_method") == 0) return needs->other_method;
  if (strcmp(what, "note") == 0) return needs->note;
  if (strcmp(what, "lean_note") == 0) return needs->lean_note;
  return strcmp(what, "method") == 0 ? hooke_options_text(needs->run, "method") : NULL;
}

/* ---- rows ---- */

static const struct hk_needs_row *row_at(const hooke_needs *needs, int64_t row) {
  return row >= 0 && row < hooke_needs_row_count(needs) ? &needs->row[row] : NULL;
}

/* Those that were run; the others wait behind them. */
int64_t hooke_needs_row_count(const hooke_needs *needs) {
  int64_t count = 0;
  while (count < needs->row_count && (needs->row[count].measured || needs->row[count].note[0]))
    count++;
  return count;
}

const char *hooke_needs_text(const hooke_needs *needs, int64_t row, const char *what) {
  const struct hk_needs_row *r = row_at(needs, row);
  if (r == NULL) return NULL;
  if (strcmp(what, "without") == 0) return r->without;
  if (strcmp(what, "kind") == 0) return r->kind;
  return strcmp(what, "note") == 0 ? r->note : NULL;
}

double hooke_needs_number(const hooke_needs *needs, int64_t row, const char *what) {
  const struct hk_needs_row *r = row_at(needs, row);
  if (r == NULL) return NAN;
  const struct hk_figure figures[] = {
      {"error", r->error},
      {"needed", r->untold ? (double)NAN : (double)r->needed},
      {"left_out", (double)r->left_out},
  };
  const double value = HOOKE_FIGURE(figures, what);
  return isnan(value) && r->measured ? cost_number(&r->cost, what) : value;
}

/* ---- the lean system ---- */

const hooke_system *hooke_needs_lean(const hooke_needs *needs) {
  return needs->lean;
}

const hooke_options *hooke_needs_lean_run(const hooke_needs *needs) {
  return needs->lean_run;
}

int64_t hooke_needs_lean_particle(const hooke_needs *needs, int64_t particle) {
  if (needs->lean == NULL || particle < 0 || particle >= needs->system->particle_count) return -1;
  return hk_variant_is_same(&needs->lean_map, particle) ? needs->lean_map.to[particle] : -1;
}

int32_t hooke_needs_lean_position(const hooke_needs *needs, const double *q, double *position) {
  if (needs->lean == NULL) {
    return hk_fail(HOOKE_BAD_CALL, NULL, "there is no lean system yet; call hooke_needs_find() first");
  }
  for (int64_t p = 0; p < needs->system->particle_count; p++)
    hk_variant_place(&needs->lean_map, p, q, position + 3 * p);
  return HOOKE_OK;
}

/* ---- resolution ---- */

int64_t hooke_needs_part_count(const hooke_needs *needs) {
  return needs->part_count;
}

const char *hooke_needs_part_text(const hooke_needs *needs, int64_t part, const char *what) {
  if (part < 0 || part >= needs->part_count) return NULL;
  if (strcmp(what, "part") == 0) return needs->part[part].name;
  return strcmp(what, "note") == 0 ? needs->part[part].note : NULL;
}

static double cells_at(const struct hk_needs_part *part, int32_t axis, double factor) {
  if (axis >= part->axes) return NAN;
  return fmax(1.0, ceil((double)part->cells[axis] * factor * (1.0 - 1e-12)));
}

double hooke_needs_part_number(const hooke_needs *needs, int64_t part, const char *what) {
  if (part < 0 || part >= needs->part_count) return NAN;
  const struct hk_needs_part *p = &needs->part[part];
  const int known = isfinite(p->factor);
  const struct hk_figure figures[] = {
      {"cells", cells_at(p, 0, 1.0)},
      {"cells_second", cells_at(p, 1, 1.0)},
      {"cells_third", cells_at(p, 2, 1.0)},
      {"change", p->change},
      {"change_fine", p->change_fine},
      {"order", p->order},
      {"error", p->error},
      {"factor", p->factor},
      {"wanted", known ? cells_at(p, 0, p->factor) : NAN},
      {"wanted_second", known ? cells_at(p, 1, p->factor) : NAN},
      {"wanted_third", known ? cells_at(p, 2, p->factor) : NAN},
  };
  return HOOKE_FIGURE(figures, what);
}
