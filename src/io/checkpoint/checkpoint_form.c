#include "io/checkpoint/checkpoint_form.h"

#include "core/crc32.h"
#include "core/table/option.h"
#include "core/status.h"
#include "model/callbacks.h"
#include "model/check_value.h"

#include <math.h>
#include <stddef.h>
#include <stdio.h>
#include <string.h>

static const char MAGIC[8] = {'h', 'o', 'o', 'k', 'e', 'C', 'K', 'P'};
enum { VERSION = 1 };

/* ---- bytes ---- */

/* The fields in the order of the file, for reading and writing. */
struct tape {
  unsigned char *at;
  int32_t writing;
};

static void move(struct tape *tape, uint64_t *bits, int count) {
  if (!tape->writing) *bits = 0;
  for (int k = 0; k < count; k++) {
    if (tape->writing)
      tape->at[k] = (unsigned char)(*bits >> 8 * k);
    else
      *bits |= (uint64_t)tape->at[k] << 8 * k;
  }
  tape->at += count;
}

static void move_u32(struct tape *tape, uint32_t *value) {
  uint64_t bits = *value;
  move(tape, &bits, 4);
  *value = (uint32_t)bits;
}

static void move_whole(struct tape *tape, int64_t *value) {
  uint64_t bits = (uint64_t)*value;
  move(tape, &bits, 8);
  *value = (int64_t)bits;
}

static void move_number(struct tape *tape, double *value) {
  uint64_t bits;
  memcpy(&bits, value, sizeof bits);
  move(tape, &bits, 8);
  memcpy(value, &bits, sizeof bits);
}

static void move_text(struct tape *tape, char *text, int64_t size) {
  if (tape->writing)
    memcpy(tape->at, text, (size_t)size);
  else
    memcpy(text, tape->at, (size_t)size);
  tape->at += size;
}

static void move_header(struct tape *tape, struct hk_checkpoint_header *h) {
  struct hk_standing *s = &h->standing;
  struct hk_counts *c = &s->count;
  move_text(tape, h->magic, sizeof h->magic);
  move_u32(tape, &h->version);
  uint32_t kind = h->has_v | h->calls << 1;
  move_u32(tape, &kind);
  h->has_v = kind & 1;
  h->calls = kind >> 1;
  move_whole(tape, &h->length);
  move_whole(tape, &h->size);
  move_u32(tape, &h->system);
  move_u32(tape, &h->options);
  move_text(tape, h->method, sizeof h->method);
  move_text(tape, h->run, sizeof h->run);
  double *const numbers[] = {&s->t0,          &s->t, &s->energy0, &s->scale0, &s->gravity0, &s->gravity_swing,
                             &s->wall_seconds};
  for (size_t k = 0; k < sizeof numbers / sizeof numbers[0]; k++)
    move_number(tape, numbers[k]);
  int64_t *const wholes[] = {&s->k,
                             &s->frames,
                             &c->steps,
                             &c->force_evaluations,
                             &c->derivative_products,
                             &c->nonlinear_iterations,
                             &c->nonlinear_failures,
                             &c->linear_iterations,
                             &c->error_test_failures};
  for (size_t k = 0; k < sizeof wholes / sizeof wholes[0]; k++)
    move_whole(tape, wholes[k]);
}

void hk_checkpoint_pack(const struct hk_checkpoint_header *header,
                        unsigned char bytes[HOOKE_CHECKPOINT_HEADER]) {
  struct hk_checkpoint_header copy = *header;
  move_header(&(struct tape){bytes, 1}, &copy);
}

void hk_checkpoint_unpack(const unsigned char bytes[HOOKE_CHECKPOINT_HEADER],
                          struct hk_checkpoint_header *header) {
  unsigned char copy[HOOKE_CHECKPOINT_HEADER];
  memcpy(copy, bytes, sizeof copy);
  move_header(&(struct tape){copy, 0}, header);
  header->standing.count.zero_passages = -1;
}

void hk_checkpoint_pack_numbers(int64_t count, const double *value, unsigned char *bytes) {
  struct tape tape = {bytes, 1};
  for (int64_t k = 0; k < count; k++) {
    double number = value[k];
    move_number(&tape, &number);
  }
}

void hk_checkpoint_unpack_numbers(int64_t count, const unsigned char *bytes, double *value) {
  for (int64_t k = 0; k < count; k++) {
    unsigned char copy[8];
    memcpy(copy, bytes + 8 * k, sizeof copy);
    move_number(&(struct tape){copy, 0}, value + k);
  }
}

/* ---- identity of the problem ---- */

uint32_t hk_checkpoint_options(const hooke_options *options) {
  uint32_t value = 0;
  for (int64_t k = 0; k < hooke_options_row_count(options); k++) {
    const char *name = hooke_options_row(options, k, "name"), *text = hooke_options_text(options, name);
    const double number = hooke_options_number(options, name);
    if (strcmp(name, "threads") == 0 || (isnan(number) && text[0] == '\0')) continue;
    value = hk_crc32(value, name, (int64_t)strlen(name) + 1);
    if (isnan(number))
      value = hk_crc32(value, text, (int64_t)strlen(text) + 1);
    else
      value = hk_crc32(value, &number, sizeof number);
  }
  return value;
}

static int64_t length_of(int64_t size, uint32_t has_v) {
  return HOOKE_CHECKPOINT_HEADER + (has_v ? 16 : 8) * size + HOOKE_CHECKPOINT_END;
}

void hk_checkpoint_describe(const hooke_integrator *it, const struct hk_standing *standing, const char *run,
                            struct hk_checkpoint_header *h) {
  memset(h, 0, sizeof *h);
  memcpy(h->magic, MAGIC, sizeof MAGIC);
  h->version = VERSION;
  h->has_v = it->system != NULL;
  h->size = it->size;
  h->length = length_of(h->size, h->has_v);
  h->calls = it->system ? (uint32_t)hk_system_calls_back(it->system) : 0;
  h->system = it->system ? hk_system_check_value(it->system) : 0;
  if (it->coordinates)
    h->system = hk_crc32(h->system, it->coordinates->inverse_mass, it->coordinates->size * 8);
  h->options = hk_checkpoint_options(it->options);
  snprintf(h->method, sizeof h->method, "%s", it->method->name);
  snprintf(h->run, sizeof h->run, "%s", run ? run : "");
  h->standing = *standing;
}

const char *hk_checkpoint_damage(const struct hk_checkpoint_header *h, int64_t length) {
  if (memcmp(h->magic, MAGIC, sizeof MAGIC) != 0) return "is no checkpoint of hooke";
  if (h->version != VERSION) return "is of a version that this library does not read";
  if (h->length != length) return "is not as long as it was written";
  if (h->calls > HOOKE_CALLS_ALL || h->size < 0 || h->size > length ||
      length_of(h->size, h->has_v) != length || h->method[HOOKE_CHECKPOINT_METHOD - 1] != '\0' ||
      h->run[HOOKE_CHECKPOINT_RUN - 1] != '\0')
    return "is damaged";
  return NULL;
}

/* ---- checks ---- */

/* Well below the overflow of counts. */
static int are_counts(const struct hk_standing *s) {
  static const int64_t most = INT64_C(1) << 62;
  const struct hk_counts *c = &s->count;
  const int64_t counts[] = {s->k,
                            s->frames,
                            c->steps,
                            c->force_evaluations,
                            c->derivative_products,
                            c->nonlinear_iterations,
                            c->nonlinear_failures,
                            c->linear_iterations,
                            c->error_test_failures};
  int fit = 1;
  for (size_t k = 0; k < sizeof counts / sizeof counts[0]; k++)
    fit &= counts[k] >= 0 && counts[k] <= most;
  return fit;
}

static int is_possible(const hooke_integrator *it, const struct hk_standing *s) {
  const struct hk_schedule *schedule = &it->schedule;
  const int planned = schedule->frames > 0;
  const double t = s->t0 + (double)s->k * schedule->step;
  if (!isfinite(s->t0) || !isfinite(s->t) || !are_counts(s) || !(s->wall_seconds >= 0.0)) return 0;
  if (planned && s->frames > schedule->frames) return 0;
  if (it->method->adaptive)
    return s->t >= s->t0 && (!planned || s->t <= s->t0 + schedule->duration) && (s->k > 0) == (s->t > s->t0);
  if (memcmp(&t, &s->t, sizeof t) != 0) return 0;
  if (!planned || s->frames == 0) return !planned || s->k == 0 || schedule->frame_steps > 0;
  /* one may be missing if the run was stopped just before it */
  const int64_t before = hk_schedule_frames_before(schedule, s->k);
  return s->k <= schedule->steps &&
         (s->frames == before || (s->frames == before + 1 && hk_schedule_has_frame(schedule, s->k)));
}

int32_t hk_checkpoint_check(const char *path, const struct hk_checkpoint_header *h,
                            const hooke_integrator *it) {
  struct hk_checkpoint_header own;
  hk_checkpoint_describe(it, &h->standing, NULL, &own);
  const int32_t status = h->calls ? hk_callbacks_check((int32_t)h->calls, (int32_t)own.calls) : HOOKE_OK;
  if (status != HOOKE_OK) return hk_fail_before(status, "%s: ", path);
  if (h->size != own.size || h->has_v != own.has_v || h->system != own.system)
    return hk_fail(HOOKE_BAD_VALUE, NULL, "%s: is of another scene", path);
  if (strcmp(h->method, own.method) != 0) {
    char shown[HOOKE_OPTION_SHOWN];
    hk_option_show(h->method, (int64_t)strlen(h->method), shown);
    return hk_fail(HOOKE_BAD_VALUE, NULL, "%s: is of a run by %s, not by %s", path, shown, own.method);
  }
  if (h->options != own.options)
    return hk_fail(HOOKE_BAD_VALUE, NULL, "%s: is of a run with other options; only threads may be changed",
                   path);
  if (!is_possible(it, &h->standing))
    return hk_fail(HOOKE_BAD_VALUE, NULL, "%s: is damaged: it is at a place where no such run comes by",
                   path);
  return HOOKE_OK;
}
