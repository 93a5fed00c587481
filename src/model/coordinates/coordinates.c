#include "model/coordinates/coordinates.h"

#include "core/memory.h"
#include "model/particles.h"
#include "model/sum/motion.h"

#include <stddef.h>

static const struct hk_coordinates_row *const table[HOOKE_COORDINATES] = {&hk_coordinates_of_bodies};

const struct hk_coordinates_row *hk_coordinates_table(int32_t k) {
  return k < HOOKE_COORDINATES ? table[k] : NULL;
}

/* ---- building ---- */

void hk_mover_add(hooke_system *system, const struct hk_coordinates_row *row, const void *thing) {
  int64_t count;
  const int32_t *particle = row->particles(thing, &count);
  system->mover[system->mover_count++] = (struct hk_mover){row, thing, system->own_count};
  system->own_count += row->numbers;
  for (int64_t k = 0; k < count; k++)
    system->carried[particle[k]] = 1;
}

int32_t hk_movers_commit(hooke_system *system) {
  int64_t count = 0;
  for (int32_t k = 0; k < HOOKE_COORDINATES; k++)
    count += table[k]->count(system);
  if (count == 0) return HOOKE_OK;
  system->mover = hk_new(count, sizeof *system->mover);
  system->carried = hk_new(system->particle_count, sizeof *system->carried);
  int32_t status = system->mover && system->carried ? HOOKE_OK : HOOKE_NO_MEMORY;
  for (int32_t k = 0; k < HOOKE_COORDINATES && status == HOOKE_OK; k++)
    status = table[k]->commit(system);
  if (status != HOOKE_OK) hk_movers_undo(system);
  return status;
}

void hk_movers_undo(hooke_system *system) {
  for (int32_t k = 0; k < HOOKE_COORDINATES; k++)
    table[k]->undo(system);
  hk_free(system->mover);
  hk_free(system->carried);
  system->mover = NULL;
  system->carried = NULL;
  system->mover_count = system->own_count = 0;
}

void hk_movers_release(hooke_system *system) {
  hk_movers_undo(system);
  for (int32_t k = 0; k < HOOKE_COORDINATES; k++)
    table[k]->release(system);
}

double hk_movers_bytes(const hooke_system *system) {
  double bytes = 0.0;
  for (int32_t k = 0; k < HOOKE_COORDINATES; k++)
    bytes += table[k]->bytes(system);
  return bytes;
}

int64_t hk_movers_memory(const hooke_system *system) {
  int64_t bytes = system->carried ? system->particle_count : 0;
  for (int32_t k = 0; k < HOOKE_COORDINATES; k++)
    bytes += table[k]->memory(system) + table[k]->count(system) * (int64_t)sizeof *system->mover;
  return bytes;
}

int32_t hk_movers_check_state(const hooke_system *system, const struct hooke_state *state) {
  int32_t status = HOOKE_OK;
  for (int32_t k = 0; k < HOOKE_COORDINATES && system->mover_count > 0 && status == HOOKE_OK; k++)
    status = table[k]->check_state(system, state);
  return status;
}

int32_t hk_movers_are_solved(const hooke_system *system) {
  int32_t solved = 1;
  for (int64_t k = 0; k < system->mover_count; k++)
    solved &= system->mover[k].row->solved;
  return solved;
}

/* ---- motion ---- */

static void read(const struct hk_mover *m, const struct hk_motion *motion, double *own) {
  m->row->read(m->thing, (const double *const *)motion->q, (const double *const *)motion->v, 1, own);
}

void hk_movers_read(const hooke_system *system, const struct hk_motion *motion, double *own) {
  for (int64_t k = 0; k < system->mover_count; k++) {
    const struct hk_mover *m = &system->mover[k];
    read(m, motion, own + m->at);
  }
}

void hk_movers_write(const hooke_system *system, struct hk_motion *motion, const double *own,
                     int32_t only_acted) {
  for (int64_t k = 0; k < system->mover_count; k++) {
    const struct hk_mover *m = &system->mover[k];
    m->row->write(system, m->thing, own + m->at, motion->q, motion->v, 1, only_acted);
  }
}

void hk_movers_push(const hooke_system *system, const struct hk_motion *motion, const double *own,
                    double *push) {
  for (int64_t k = 0; k < system->mover_count; k++) {
    const struct hk_mover *m = &system->mover[k];
    m->row->push(system, m->thing, motion, own + m->at, push + HOOKE_PUSH * k);
  }
}

void hk_movers_normalise(const hooke_system *system, double *own) {
  for (int64_t k = 0; k < system->mover_count; k++) {
    const struct hk_mover *m = &system->mover[k];
    if (m->row->normalise) m->row->normalise(own + m->at);
  }
}

void hk_movers_tolerance(const hooke_system *system, double position, double velocity, double *tolerance) {
  for (int64_t k = 0; k < system->mover_count; k++) {
    const struct hk_mover *m = &system->mover[k];
    m->row->tolerance(m->thing, position, velocity, tolerance + m->at);
  }
}

void hk_movers_slope(const hooke_system *system, const double *own, const double *push, double *slope) {
  for (int64_t k = 0; k < system->mover_count; k++) {
    const struct hk_mover *m = &system->mover[k];
    m->row->slope(m->thing, own + m->at, push + HOOKE_PUSH * k, slope + m->at);
  }
}

void hk_movers_accelerate(const hooke_system *system, const struct hk_motion *motion, double *out) {
  for (int64_t k = 0; k < system->mover_count; k++) {
    const struct hk_mover *m = &system->mover[k];
    double own[HOOKE_MOST_OWN], push[HOOKE_PUSH];
    read(m, motion, own);
    m->row->push(system, m->thing, motion, own, push);
    m->row->accelerate(system, m->thing, own, push, out);
  }
}

void hk_movers_renew(const hooke_system *system, double *q, double *v) {
  double *const to[2][3] = {{q, q + 1, q + 2}, {v, v + 1, v + 2}};
  const double *const from[2][3] = {{q, q + 1, q + 2}, {v, v + 1, v + 2}};
  for (int64_t k = 0; k < system->mover_count; k++) {
    const struct hk_mover *m = &system->mover[k];
    double own[HOOKE_MOST_OWN];
    m->row->read(m->thing, from[0], from[1], 3, own);
    m->row->write(system, m->thing, own, to[0], to[1], 3, 0);
  }
}
