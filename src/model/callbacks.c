#include "model/callbacks.h"

#include "core/status.h"
#include "model/force/drive.h"
#include "model/system.h"

#include <stddef.h>
#include <string.h>

static const char *const texts[HOOKE_CALLS_ALL + 1] = {
    "none",  "force",           "", "force with derivative",
    "drive", "force and drive", "", "force with derivative and drive"};

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

static int32_t missing(int32_t had) {
  return hk_fail(HOOKE_UNSUITED, NULL,
                 "the run had a %s in a callback, which the file cannot hold; a program that gives it again "
                 "can repeat the run or go on with it",
                 hk_callbacks_text(had));
}

int32_t hk_callbacks_check(int32_t had, int32_t own) {
  if (had < 0 || had == own) return HOOKE_OK;
  if (had & ~own) return missing(had);
  return hk_fail(HOOKE_UNSUITED, NULL, "callbacks: the run had %s, and this system has %s",
                 hk_callbacks_text(had), hk_callbacks_text(own));
}

int32_t hk_callbacks_require(const hooke_system *system) {
  const int32_t lacks = system->rest->called & ~hk_system_calls_back(system) & ~HOOKE_CALLS_DERIVATIVE;
  return lacks ? missing(system->rest->called) : HOOKE_OK;
}
