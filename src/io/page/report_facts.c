/* Facts that all pages show: date, machine and versions, and steps. */
#include "core/status.h"
#include "io/page/report.h"

#include <errno.h>
#include <math.h>
#include <stdio.h>
#include <string.h>
#include <sys/utsname.h>
#include <time.h>
#include <unistd.h>

/* Name of the processor from Linux; "" elsewhere. HOOKE_NO_MEMORY. */
static int32_t find_processor(char *name, size_t size) {
  char line[256];
  name[0] = '\0';
  FILE *file = fopen("/proc/cpuinfo", "r");
  if (file == NULL && errno == ENOMEM)
    return hk_fail(HOOKE_NO_MEMORY, NULL, "no memory to describe the machine");
  if (file == NULL) return HOOKE_OK;
  while (name[0] == '\0' && fgets(line, sizeof line, file)) {
    const char *colon = strchr(line, ':');
    if (strncmp(line, "model name", 10) != 0 || colon == NULL) continue;
    colon += 1 + strspn(colon + 1, " ");
    snprintf(name, size, "%.*s", (int)strcspn(colon, "\n"), colon);
  }
  fclose(file);
  return HOOKE_OK;
}

static void add_machine(struct hk_text *text) {
  char processor[256], kernel[160] = "";
  struct utsname name;
  if (text->status == HOOKE_OK) text->status = find_processor(processor, sizeof processor);
  if (text->status != HOOKE_OK) return;
  if (uname(&name) == 0) snprintf(kernel, sizeof kernel, "%.64s, %.64s", name.sysname, name.machine);
  const long cores = sysconf(_SC_NPROCESSORS_ONLN);
  hk_text_open(text, "machine", '{');
  hk_text_word(text, "processor", processor[0] ? processor : NULL);
  hk_text_number(text, "cores", cores > 0 ? (double)cores : NAN);
  hk_text_word(text, "system", kernel);
  hk_text_close(text, '}');
}

static void add_versions(struct hk_text *text) {
  static const char *const facts[] = {"sundials", "cholmod", "lapack",  "gsl",          "arpack", "hdf5",
                                      "jansson",  "chartjs", "threejs", "instructions", "licence"};
  hk_text_open(text, "versions", '{');
  hk_text_word(text, "hooke", hooke_version());
  for (int k = 0; k < (int)(sizeof facts / sizeof facts[0]); k++)
    hk_text_word(text, facts[k], hooke_build_fact(facts[k]));
  hk_text_close(text, '}');
}

static void add_date(struct hk_text *text) {
  char date[32] = "";
  const time_t now = time(NULL);
  struct tm parts;
  if (gmtime_r(&now, &parts)) strftime(date, sizeof date, "%Y-%m-%d %H:%M UTC", &parts);
  hk_text_word(text, "date", date);
}

void hk_report_add_facts(struct hk_text *text) {
  add_date(text);
  add_machine(text);
  add_versions(text);
}

void hk_report_add_step(struct hk_text *data, const char *key, double step) {
  if (step == INFINITY)
    hk_text_word(data, key, "none");
  else
    hk_text_number(data, key, step);
}
