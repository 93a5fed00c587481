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

static int64_t length_of(int64_t size, uint32_t kind) {
  return HOOKE_CHECKPOINT_HEADER + (kind & 1 ? 16 : 8) * size + HOOKE_CHECKPOINT_END;
}

void hk_checkpoint_describe(const hooke_integrator *it, const struct hk_standing *standing, const char *run,
                            struct hk_checkpoint_header *h) {
  memset(h, 0, sizeof *h);
  memcpy(h->magic, MAGIC, sizeof MAGIC);
  h->version = VERSION;
  if (it->system) h->kind = 1 | (uint32_t)hk_system_calls_back(it->system) << 1;
  h->size = it->size;
  h->length = length_of(h->size, h->kind);
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
  if (h->kind >> 1 > HOOKE_CALLS_ALL || h->size < 0 || h->size > length ||
      length_of(h->size, h->kind) != length || h->method[HOOKE_CHECKPOINT_METHOD - 1] != '\0' ||
      h->run[HOOKE_CHECKPOINT_RUN - 1] != '\0')
    return "is damaged";
  return NULL;
}

/* ---- checks ---- */

/* Well below the overflow of counts. */
static int are_counts(const struct hk_standing *s) {
  int64_t counts[9];
  int fit = 1;
  memcpy(counts, (const char *)s + offsetof(struct hk_standing, k), sizeof counts);
  for (size_t k = 0; k < sizeof counts / sizeof counts[0]; k++)
    fit &= counts[k] >= 0 && counts[k] <= INT64_C(1) << 62;
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
  const int32_t calls = (int32_t)(h->kind >> 1);
  const int32_t status = calls ? hk_callbacks_check(calls, (int32_t)(own.kind >> 1)) : HOOKE_OK;
  if (status != HOOKE_OK) return hk_fail_before(status, "%s: ", path);
  if (h->size != own.size || (h->kind & 1) != (own.kind & 1) || h->system != own.system)
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
