#include "resume.h"

#include "print.h"
#include "report.h"

#include <math.h>
#include <stdio.h>
#include <string.h>

static int32_t may_be_given(const char *name) {
  static const char *const names[] = {"resume", "threads", "final", "json", "quiet", "help"};
  for (size_t k = 0; k < sizeof names / sizeof names[0]; k++) {
    if (strcmp(names[k], name) == 0) return 1;
  }
  return 0;
}

int hooke_resume_check(const struct hooke_arguments *arguments) {
  const char *file = hooke_arguments_text(arguments, "resume");
  if (!file && hooke_arguments_text(arguments, "checkpoint") && !hooke_arguments_text(arguments, "output")) {
    return hooke_report(arguments, HOOKE_EXIT_USAGE,
                        "--checkpoint keeps places to go on from beside the output; give one with -o OUT.h5");
  }
  for (int32_t i = 0; file && i < arguments->count; i++) {
    const struct hooke_argument *argument = &arguments->all[i];
    if (!argument->text || may_be_given(argument->name)) continue;
    return hooke_report(
        arguments, HOOKE_EXIT_USAGE,
        "--resume goes on with the scene and the options of %s, so that the bits are those of a run that "
        "never stopped; leave out --%s",
        file, argument->flag);
  }
  return HOOKE_EXIT_DONE;
}

void hooke_resume_tell_how(const struct hooke_arguments *arguments, const char *output, int32_t kept) {
  if (kept == HOOKE_UNSUITED)
    hooke_report_words(
        arguments,
        "this method goes on from checkpoints alone, and --checkpoint DT was not given: it begins again");
  fputs("to go on:\n  hooke run --resume ", stderr);
  hooke_print_quoted(stderr, output);
  fputc('\n', stderr);
}

static void print_json(const struct hooke_arguments *arguments, const hooke_system *system,
                       const hooke_options *options, double time, double before, double after) {
  struct hooke_json json;
  const char *method = hooke_options_text(options, "method");
  const int adaptive = hooke_method_is_adaptive(method) == 1;
  hooke_json_begin(&json, stdout);
  hooke_json_text(&json, "status", "finished");
  hooke_json_text(&json, "method", method);
  if (!adaptive) hooke_json_number(&json, "step", hooke_options_number(options, "step"));
  if (adaptive) hooke_json_number(&json, "rtol", hooke_options_number(options, "rtol"));
  if (adaptive) hooke_json_number(&json, "atol", hooke_options_number(options, "atol"));
  hooke_json_number(&json, "time", time);
  static const char *const unknown[] = {"steps", "force_evaluations", "wall_seconds"};
  for (int k = 0; k < 3; k++)
    hooke_json_number(&json, unknown[k], NAN);
  hooke_json_count(&json, "particles", hooke_system_particle_count(system));
  hooke_json_count(&json, "springs", hooke_system_spring_count(system));
  hooke_json_open(&json, "energy", '{');
  hooke_json_number(&json, "initial", before);
  hooke_json_number(&json, "final", after);
  hooke_json_close(&json);
  hooke_json_text(&json, "output", arguments->scene);
  hooke_json_end(&json);
}

static double energy_of(const hooke_system *system, const hooke_state *state) {
  return hooke_system_energy(system, hooke_state_position(state), hooke_state_velocity(state));
}

int hooke_resume_tell_finished(const struct hooke_arguments *arguments, const struct hooke_setup *setup) {
  hooke_record *record = NULL;
  int32_t status = hooke_record_open(arguments->scene, &record);
  const double before = energy_of(setup->system, setup->state);
  if (status == HOOKE_OK) status = hooke_record_read(record, -1, setup->state);
  hooke_record_close(record);
  if (status != HOOKE_OK) return hooke_report_status(arguments, status);
  if (!arguments->quiet)
    hooke_report_words(arguments, "the run of %s had finished; there is nothing to go on with",
                       arguments->scene);
  if (arguments->json)
    print_json(arguments, setup->system, setup->options, hooke_state_time(setup->state), before,
               energy_of(setup->system, setup->state));
  return HOOKE_EXIT_DONE;
}
