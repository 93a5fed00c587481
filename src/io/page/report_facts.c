/* Facts that all pages show: date, machine and versions, and steps. */
#include "core/os/os.h"
#include "core/status.h"
#include "io/page/report.h"

#include <math.h>
#include <stdio.h>
#include <time.h>

static void add_machine(struct hk_text *text) {
  struct hk_os_machine machine;
  if (text->status == HOOKE_OK && hk_os_describe_machine(&machine) != 0)
    text->status = hk_fail(HOOKE_NO_MEMORY, NULL, "no memory to describe the machine");
  if (text->status != HOOKE_OK) return;
  hk_text_open(text, "machine", '{');
  hk_text_word(text, "processor", machine.processor[0] ? machine.processor : NULL);
  hk_text_number(text, "cores", machine.cores > 0 ? (double)machine.cores : (double)NAN);
  hk_text_word(text, "system", machine.system);
  hk_text_close(text, '}');
}

static void add_versions(struct hk_text *text) {
  static const char *const facts[] = {"sundials", "cholmod", "lapack",  "gsl",          "arpack",
                                      "hdf5",     "chartjs", "threejs", "instructions", "licence"};
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
