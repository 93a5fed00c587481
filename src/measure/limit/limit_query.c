/* Reading a limit. */
#include "measure/limit/limit.h"

#include "core/figure.h"

#include <math.h>
#include <string.h>

double hooke_limit_figure(const hooke_limit *limit, const char *what) {
  if (!limit->found) return NAN;
  const struct hk_figure figures[] = {
      {"frequency_max", limit->frequency},  {"rate_max", limit->decay},
      {"modes", (double)limit->mode_count}, {"products", (double)limit->products},
      {"clamped", (double)limit->clamped},
  };
  return HOOKE_FIGURE(figures, what);
}

/* ---- rows ---- */

static const struct hk_limit_row *row_at(const hooke_limit *limit, int64_t row) {
  return row >= 0 && row < limit->row_count ? &limit->row[row] : NULL;
}

int64_t hooke_limit_row_count(const hooke_limit *limit) {
  return limit->row_count;
}

const char *hooke_limit_text(const hooke_limit *limit, int64_t row, const char *what) {
  const struct hk_limit_row *r = row_at(limit, row);
  if (r == NULL) return NULL;
  if (strcmp(what, "method") == 0) return r->method;
  return strcmp(what, "note") == 0 ? r->note : NULL;
}

double hooke_limit_number(const hooke_limit *limit, int64_t row, const char *what) {
  const struct hk_limit_row *r = row_at(limit, row);
  if (r == NULL) return NAN;
  const int32_t found = limit->found;
  const int comparable = r->predicted > 0.0 && isfinite(r->predicted) && isfinite(r->measured);
  const struct hk_figure figures[] = {
      {"bound", r->bound},
      {"predicted", r->predicted},
      {"exact", found ? (double)r->exact : (double)NAN},
      {"measured", r->measured},
      {"ratio", comparable ? r->measured / r->predicted : NAN},
      {"steps_run", r->steps_run},
      {"never_stable", found ? (double)r->never_stable : (double)NAN},
      {"by_eigenvalue", (double)hk_limit_rule_needs_all(r->method)},
      {"smallest", r->smallest},
      {"smallest_time", r->smallest_time},
  };
  return HOOKE_FIGURE(figures, what);
}

/* ---- blame ---- */

/* 1 if a force has the first place. */
static int64_t blames_force(const hooke_limit *limit) {
  return hk_blame_force(&limit->blame) >= 0;
}

int64_t hooke_limit_blame_count(const hooke_limit *limit) {
  return limit->blame.spring_count + blames_force(limit);
}

double hooke_limit_blame_number(const hooke_limit *limit, int64_t place, const char *what) {
  if (place < 0 || place >= hooke_limit_blame_count(limit)) return NAN;
  if (blames_force(limit) && place == 0) {
    const double share = limit->blame.force_share[hk_blame_force(&limit->blame)];
    return strcmp(what, "share") == 0 ? share : (double)NAN;
  }
  const struct hk_blamed_spring *s = &limit->blame.spring[place - blames_force(limit)];
  const struct hk_figure figures[] = {{"spring", (double)s->spring},
                                      {"first", (double)s->first},
                                      {"second", (double)s->second},
                                      {"share", s->share}};
  return HOOKE_FIGURE(figures, what);
}

const char *hooke_limit_blame_text(const hooke_limit *limit, int64_t place, const char *what) {
  if (place < 0 || place >= hooke_limit_blame_count(limit)) return NULL;
  const int32_t force = place == 0 ? hk_blame_force(&limit->blame) : -1;
  if (strcmp(what, "force") == 0) return hk_blame_force_name(force);
  if (strcmp(what, "group") != 0) return NULL;
  if (force >= 0) return "";
  return hooke_system_group_name(limit->system, limit->blame.spring[place - blames_force(limit)].group);
}

int64_t hooke_limit_mover_count(const hooke_limit *limit) {
  return limit->blame.particle_count;
}

double hooke_limit_mover_number(const hooke_limit *limit, int64_t place, const char *what) {
  if (place < 0 || place >= limit->blame.particle_count) return NAN;
  const struct hk_blamed_particle *p = &limit->blame.particle[place];
  const struct hk_figure figures[] = {
      {"particle", (double)p->particle}, {"share", p->share}, {"mass", p->mass}};
  return HOOKE_FIGURE(figures, what);
}

const char *hooke_limit_remedy_text(const hooke_limit *limit, const char *what) {
  const struct hk_remedy *r = &limit->remedy;
  if (strcmp(what, "kind") == 0) return r->kind;
  return strcmp(what, "sentence") == 0 && r->sentence[0] ? r->sentence : NULL;
}

double hooke_limit_remedy_number(const hooke_limit *limit, const char *what) {
  const struct hk_remedy *r = &limit->remedy;
  if (r->kind == NULL) return NAN;
  const int soften = strcmp(r->kind, "soften") == 0;
  const struct hk_figure figures[] = {{"springs", soften ? (double)r->count : NAN},
                                      {"particles", soften ? NAN : (double)r->count},
                                      {"factor", r->factor},
                                      {"cost", r->cost},
                                      {"gain", r->gain},
                                      {"gain_predicted", r->gain_predicted}};
  return HOOKE_FIGURE(figures, what);
}

/* ---- modes ---- */

int64_t hooke_limit_mode_count(const hooke_limit *limit) {
  return limit->mode_count;
}

double hooke_limit_mode_number(const hooke_limit *limit, int64_t mode, const char *what) {
  if (mode < 0 || mode >= limit->mode_count) return NAN;
  const struct hk_limit_mode *m = &limit->mode[mode];
  const struct hk_figure figures[] = {
      {"real", m->real}, {"imaginary", m->imaginary}, {"frequency", m->frequency}, {"decay", m->decay}};
  return HOOKE_FIGURE(figures, what);
}

const double *hooke_limit_shape(const hooke_limit *limit) {
  return limit->found && hk_limit_blamed(limit) ? limit->shape : NULL;
}
