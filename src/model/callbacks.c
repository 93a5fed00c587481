#include "model/callbacks.h"

#include "core/print.h"
#include "core/status.h"
#include "model/force/drive.h"
#include "model/system.h"

#include <string.h>

static const char *const texts[HOOKE_CALLS_ALL + 1] = {
    "none",  "force",           "", "force with derivative",
    "drive", "force and drive", "", "force with derivative and drive"};

const char *const hk_force_texts[HOOKE_FORCE_TEXTS] = {"force_file", "force_name", "force_sha256"};

int32_t hk_system_calls_back(const hooke_system *system) {
  int32_t calls = system->force ? HOOKE_CALLS_FORCE : 0;
  if (system->force && system->force_product) calls |= HOOKE_CALLS_DERIVATIVE;
  for (int64_t g = 0; g < system->drive_count; g++)
    if (system->drive[g].callback) calls |= HOOKE_CALLS_DRIVE;
  return calls;
}

const char *hk_callbacks_text(int32_t calls) {
  return texts[calls & HOOKE_CALLS_ALL];
}

int32_t hk_callbacks_find(const char *text) {
  int32_t calls = text[0] ? HOOKE_CALLS_ALL : -1;
  while (calls >= 0 && strcmp(text, texts[calls]) != 0)
    calls--;
  return calls;
}

/* ---- where a force is from ---- */

char *const *hk_force_from(const hooke_system *system) {
  return system->force && system->force == system->rest->named ? system->rest->named_from : NULL;
}

const char *hk_force_called(const hooke_system *system, char *name, size_t size) {
  char *const *from = hk_force_from(system);
  hk_print(name, size, from ? "the force of %s" : "the force callback", from ? from[HOOKE_FORCE_FILE] : "");
  return name;
}

int32_t hooke_system_name_force(hooke_system *system, const char *file, const char *name,
                                const char *digest) {
  const int32_t status = hk_system_require_open(system);
  if (status != HOOKE_OK) return status;
  if (system->force == NULL)
    return hk_fail(HOOKE_BAD_CALL, NULL, "there is no force to name; call hooke_system_set_force() first");
  memcpy(system->rest->named_from, ((const char *[]){file, name, digest}), sizeof system->rest->named_from);
  system->rest->named = system->force;
  return HOOKE_OK;
}

static int32_t is_said(char *const *from, int k) {
  return from && from[k] && from[k][0];
}

int32_t hk_force_check(char *const *had, const hooke_system *system) {
  char *const *own = hk_force_from(system);
  const int32_t said = is_said(had, HOOKE_FORCE_DIGEST);
  if (own == NULL || (said && strcmp(had[HOOKE_FORCE_DIGEST], own[HOOKE_FORCE_DIGEST]) == 0 &&
                      strcmp(had[HOOKE_FORCE_NAME], own[HOOKE_FORCE_NAME]) == 0))
    return HOOKE_OK;
  return hk_fail(HOOKE_UNSUITED, NULL, "the run had %s%s%s%s%s, and this system has %s of %s, SHA-256 %s",
                 said ? had[HOOKE_FORCE_NAME] : "no force, or one that its file does not name",
                 said ? " of " : "", said ? had[HOOKE_FORCE_FILE] : "", said ? ", SHA-256 " : "",
                 said ? had[HOOKE_FORCE_DIGEST] : "", own[HOOKE_FORCE_NAME], own[HOOKE_FORCE_FILE],
                 own[HOOKE_FORCE_DIGEST]);
}

/* ---- of a run that is gone on with ---- */

static int32_t missing(int32_t had, char *const *from) {
  if (is_said(from, HOOKE_FORCE_FILE))
    return hk_fail(
        HOOKE_UNSUITED, NULL,
        "the run had the force %s of %s, SHA-256 %s, which has to be given again: --force FILE:NAME",
        from[HOOKE_FORCE_NAME], from[HOOKE_FORCE_FILE], from[HOOKE_FORCE_DIGEST]);
  return hk_fail(HOOKE_UNSUITED, NULL,
                 "the run had a %s in a callback, which the file cannot hold; a program that gives it again "
                 "can repeat the run or go on with it",
                 hk_callbacks_text(had));
}

int32_t hk_callbacks_check(int32_t had, int32_t own) {
  if (had < 0 || had == own) return HOOKE_OK;
  if (had & ~own) return missing(had, NULL);
  return hk_fail(HOOKE_UNSUITED, NULL, "callbacks: the run had %s, and this system has %s",
                 hk_callbacks_text(had), hk_callbacks_text(own));
}

int32_t hk_callbacks_require(const hooke_system *system) {
  const struct hk_system_rest *rest = system->rest;
  const int32_t lacks = rest->called & ~hk_system_calls_back(system) & ~HOOKE_CALLS_DERIVATIVE;
  if (lacks) return missing(rest->called, rest->called_from);
  return rest->called ? hk_force_check(rest->called_from, system) : HOOKE_OK;
}
