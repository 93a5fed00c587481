/* hooke run: integrates a scene and reports the result. */
#include "blow_up.h"
#include "command.h"
#include "os.h"
#include "probes.h"
#include "report.h"

#include <errno.h>
#include <inttypes.h>
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

static const double MOST_STEPS = 9007199254740992.0; /* 2^53, up to which doubles hold every integer */
static const char MAY_BE_GIVEN[] = "resume threads final watch force no-why json quiet help";

/* Of the state; the scale becomes the largest sum of its kinds without their signs. */
static double state_energy(struct cli_run *run) {
  const hooke_system *system = run->setup.system;
  const double *q = hooke_state_position(run->setup.state), *v = hooke_state_velocity(run->setup.state);
  const double t = hooke_state_time(run->setup.state);
  double scale = hooke_system_energy(system, "kinetic", q, v);
  for (int64_t k = 0; hooke_system_force_name(system, k); k++) {
    const double energy = hooke_system_energy_at(system, hooke_system_force_name(system, k), t, q, v);
    if (!isnan(energy)) scale += fabs(energy); /* drag and callbacks have none */
  }
  run->energy_scale = fmax(run->energy_scale, scale);
  return hooke_system_energy_at(system, "total", t, q, v);
}

/* ---- running ---- */

static void keep_message(struct cli_run *run) {
  snprintf(run->message, sizeof run->message, "%s", hooke_last_error());
}

static int32_t see_frame(int64_t step, const hooke_state *state, void *ctx) {
  struct cli_run *run = ctx;
  const int beyond = !isnan(hooke_integrator_number(run->integrator, "diverged_at"));
  if (run->trajectory && beyond) run->write_status = hooke_trajectory_mark_diverged(run->trajectory);
  if (run->trajectory && run->write_status == HOOKE_OK)
    run->write_status = hooke_trajectory_write(run->trajectory, step, state);
  if (run->write_status != HOOKE_OK) {
    keep_message(run);
    return 1;
  }
  run->frames++;
  run->frames_beyond += beyond;
  if (!beyond) run->last_frame = hooke_state_time(state);
  return run->estimate && !beyond ? hooke_estimate_see(step, state, run->estimate) : 0;
}

static int32_t see_checkpoint(int64_t step, const hooke_state *state, void *ctx) {
  struct cli_run *run = ctx;
  (void)step;
  if (run->trajectory && !run->page)
    run->write_status = hooke_trajectory_checkpoint(run->trajectory, run->integrator, state);
  if (run->write_status == HOOKE_OK) return 0;
  keep_message(run);
  return 1;
}

/* A run that soon blows up is told of by that alone. */
static int32_t see_long(int64_t step, const hooke_state *state, void *ctx) {
  struct cli_run *run = ctx;
  (void)step, (void)state;
  cli_warnings_tell(run->arguments, run->warnings);
  return 0;
}

/* Steps of about a second of work. */
static int64_t steps_of_a_second(const hooke_system *system) {
  const int64_t size = hooke_system_particle_count(system) + hooke_system_count(system, "springs");
  return 1 + 200000000 / (50 + size);
}

static int32_t watch_warnings(struct cli_run *run) {
  const int32_t status = hooke_integrator_on_warning(run->integrator, cli_warnings_hear, run->warnings);
  if (status != HOOKE_OK) return status;
  return hooke_integrator_on_step(run->integrator, steps_of_a_second(run->setup.system), see_long, run);
}

static int32_t prepare(struct cli_run *run) {
  int32_t status = run->resumed ? HOOKE_OK : hooke_step_settle(run->setup.system, run->setup.options);
  if (status == HOOKE_OK)
    status = hooke_integrator_create(run->setup.system, run->setup.options, &run->integrator);
  if (status == HOOKE_OK)
    status = hooke_options_copy(hooke_integrator_options(run->integrator), &run->options);
  if (status != HOOKE_OK) return status;
  run->duration = hooke_options_number(run->options, "duration");
  status = hooke_integrator_on_frame(run->integrator, see_frame, run);
  if (status == HOOKE_OK)
    status =
        hooke_integrator_on_progress(run->integrator, HOOKE_BETWEEN_LOOKS, cli_watch_progress, &run->watch);
  if (status == HOOKE_OK) status = hooke_integrator_on_checkpoint(run->integrator, see_checkpoint, run);
  /* a pick has computed the limits already */
  const int warns = !run->arguments->quiet && !cli_arguments_text(run->arguments, "want");
  if (status == HOOKE_OK && warns) status = watch_warnings(run);
  if (status == HOOKE_OK) status = cli_probes_begin(run);
  if (status != HOOKE_OK || !run->output) return status;
  status = run->resumed
               ? hooke_trajectory_resume(run->output, run->setup.system, run->integrator, run->setup.state,
                                         &run->trajectory)
               : hooke_trajectory_create(run->output, run->setup.system, run->integrator,
                                         hooke_scene_text(run->setup.scene, "text"), &run->trajectory);
  if (status != HOOKE_OK || !run->trajectory) return status;
  if (run->resumed && !run->arguments->quiet)
    cli_report_words(run->arguments, "goes on from %s", hooke_trajectory_text(run->trajectory, "origin"));
  return hooke_trajectory_write_behind(run->trajectory);
}

/* Says how to continue an interrupted run. Some methods need a checkpoint of --checkpoint, and no run
 * continues from non-finite numbers. */
static void keep_place(struct cli_run *run) {
  if (run->outcome != HOOKE_STOPPED || run->write_status != HOOKE_OK || !run->trajectory || run->page) return;
  run->kept_place = hooke_trajectory_checkpoint(run->trajectory, run->integrator, run->setup.state);
  if (run->kept_place != HOOKE_IO_FAILED && run->kept_place != HOOKE_NO_MEMORY) return;
  run->write_status = run->kept_place;
  keep_message(run);
}

/* Writes the ParaView companion. A name that it cannot use is not a failure of the run. */
static int32_t write_companion(struct cli_run *run) {
  hooke_record *record = NULL;
  int32_t status = hooke_record_open(run->output, &record);
  if (status == HOOKE_OK) run->frames = hooke_record_count(record, "frames");
  if (status == HOOKE_OK) status = hooke_record_write_xdmf(record, NULL);
  hooke_record_close(record);
  if (status != HOOKE_BAD_VALUE) return status;
  if (!run->arguments->quiet) cli_report_words(run->arguments, "no .xdmf is written: %s", hooke_last_error());
  return HOOKE_OK;
}

static int32_t ask_why(struct cli_run *run) {
  int32_t status = hooke_why_create(run->integrator, NULL, &run->why);
  if (status == HOOKE_OK) status = cli_watch_run(run->arguments, run->why, NULL);
  return status == HOOKE_OK ? cli_advice_label(run->arguments, run->why) : status;
}

/* The outcome is the same without an explanation. */
static void find_why(struct cli_run *run) {
  if (cli_arguments_text(run->arguments, "no-why")) return;
  const int32_t status = cli_watch_interrupted() ? HOOKE_STOPPED : ask_why(run);
  if (status == HOOKE_OK) {
    snprintf(run->message, sizeof run->message, "%s", hooke_measurement_text(run->why, "why", 0, "sentence"));
    return;
  }
  hooke_measurement_destroy(run->why);
  run->why = NULL;
  if (status == HOOKE_NO_MEMORY)
    cli_report_words(run->arguments, "out of memory: why the run ended early is not looked into");
  if (status == HOOKE_STOPPED)
    cli_report_words(run->arguments, "%s: why the run ended early is not looked into further",
                     cli_force_stop());
}

/* Number of the step after which the last of `frames` was written; -1 if the file does not say. */
static int32_t read_steps(hooke_record *record, int64_t frames, int64_t *steps) {
  int64_t rows = 0, columns = 0;
  *steps = -1;
  int32_t status = hooke_record_size(record, "step", &rows, &columns);
  if (status != HOOKE_OK || frames < 1 || rows < frames || columns != 1) return status;
  double *all = malloc((size_t)rows * sizeof *all);
  if (all == NULL) return HOOKE_NO_MEMORY;
  status = hooke_record_numbers(record, "step", all);
  if (status == HOOKE_OK && all[frames - 1] >= 0.0 && all[frames - 1] <= MOST_STEPS)
    *steps = (int64_t)all[frames - 1];
  free(all);
  return status;
}

static int32_t read_finished(struct cli_run *run) {
  hooke_record *record = NULL;
  int32_t status = hooke_record_open(run->output, &record);
  if (status == HOOKE_OK) status = hooke_record_read(record, -1, run->setup.state);
  if (status == HOOKE_OK) run->frames = hooke_record_count(record, "frames");
  if (status == HOOKE_OK) status = read_steps(record, run->frames, &run->finished_steps);
  hooke_record_close(record);
  return status;
}

/* Reports a run that had finished already. */
static int take_finished(struct cli_run *run) {
  const int32_t status = read_finished(run);
  if (status == HOOKE_NO_MEMORY) return cli_report(run->arguments, HOOKE_EXIT_BAD_INPUT, "out of memory");
  if (status != HOOKE_OK) return cli_report_status(run->arguments, status);
  run->energy_after = state_energy(run);
  if (!run->arguments->quiet)
    cli_report_words(run->arguments, "the run of %s had finished; there is nothing to go on with%s",
                     run->output,
                     cli_arguments_text(run->arguments, "watch") ? ", and no step to watch" : "");
  return HOOKE_EXIT_DONE;
}

/* Of a run that could not take its first step. */
static int give_up(struct cli_run *run, int32_t status) {
  const int code = cli_report_status(run->arguments, status);
  (void)cli_probes_end(run);
  (void)hooke_trajectory_close(run->trajectory, status);
  run->trajectory = NULL;
  return code;
}

/* A failed write is why the run was stopped. */
static void end_probes(struct cli_run *run) {
  const int32_t status = cli_probes_end(run);
  if (status == HOOKE_OK || run->write_status != HOOKE_OK) return;
  run->write_status = status;
  keep_message(run);
}

/* Runs and closes the trajectory; a failure is reported and returned as exit code. */
static int integrate(struct cli_run *run) {
  cli_watch_start(&run->watch, run->arguments);
  run->last_frame = NAN;
  run->energy_before = state_energy(run);
  run->coincident_before =
      hooke_system_coincident_springs(run->setup.system, hooke_state_position(run->setup.state));
  int32_t status = prepare(run);
  run->was_finished = status == HOOKE_OK && run->resumed && !run->trajectory;
  if (run->was_finished) return take_finished(run);
  if (status == HOOKE_OK && run->estimate)
    status = hooke_estimate_begin(run->estimate, run->integrator, run->setup.state);
  if (status == HOOKE_OK && run->estimate) status = hooke_estimate_follow(run->estimate, run->integrator);
  if (status != HOOKE_OK) return give_up(run, status);
  run->outcome = run->resumed ? hooke_integrator_resume(run->integrator, run->setup.state)
                              : hooke_integrator_run(run->integrator, run->setup.state);
  if (run->outcome != HOOKE_OK && run->write_status == HOOKE_OK) keep_message(run);
  cli_watch_end(&run->watch);
  cli_run_take_counts(run);
  run->energy_after = state_energy(run);
  end_probes(run);
  keep_place(run);
  status = hooke_trajectory_close(run->trajectory, run->outcome);
  run->trajectory = NULL;
  if (run->write_status != HOOKE_OK)
    return cli_report(run->arguments, cli_exit_code(run->write_status), "%s", run->message);
  int code = cli_exit_code(run->outcome);
  if (status != HOOKE_OK && (run->outcome >= 0 || code == HOOKE_EXIT_DIVERGED)) {
    if (run->outcome != HOOKE_OK) cli_report_words(run->arguments, "%s", run->message);
    return cli_report_status(run->arguments, status);
  }
  if (run->outcome < 0 && code != HOOKE_EXIT_DIVERGED) {
    return cli_report(run->arguments, code, "%s", run->message);
  }
  if (run->output && !run->page) status = write_companion(run);
  return status == HOOKE_OK ? HOOKE_EXIT_DONE : cli_report_status(run->arguments, status);
}

static void tell_how(const struct cli_run *run) {
  if (run->kept_place == HOOKE_UNSUITED)
    cli_report_words(
        run->arguments,
        "this method goes on from checkpoints alone, and --checkpoint DT was not given: it begins again");
  fputs("to go on:\n  hooke run --resume ", stderr);
  cli_print_quoted(stderr, run->output);
  const char *force = cli_arguments_text(run->arguments, "force");
  if (force) fputs(" --force ", stderr);
  if (force) cli_print_quoted(stderr, force);
  fputc('\n', stderr);
}

/* On standard error: that a run was interrupted, and what is kept. */
static void tell_interrupted(const struct cli_run *run) {
  const struct cli_arguments *arguments = run->arguments;
  char kept[sizeof run->message] = "", lines[sizeof run->message / 2] = "";
  if (run->output) {
    snprintf(kept, sizeof kept, ", and %" PRId64 " frame%s in %s", run->frames, run->frames == 1 ? "" : "s",
             run->output);
  }
  if (run->probes_file)
    snprintf(lines, sizeof lines, ", and %" PRId64 " line%s in %s", run->lines, run->lines == 1 ? "" : "s",
             run->probes_file);
  cli_report_words(arguments, "%s at t = %.6g s; kept: the state then%s%s", cli_force_stop(),
                   hooke_state_time(run->setup.state), kept, lines);
  if (run->output && !cli_force_failed()) tell_how(run);
}

static void tell_coincident(const struct cli_run *run) {
  const int64_t before = run->coincident_before, after = cli_run_coincident(run);
  if (before > 0) {
    cli_report_words(run->arguments,
                     "%" PRId64
                     " springs or contacts began without a direction, with both ends, or particle and "
                     "centre, at one place; they exert no force until something else parts them",
                     before);
  }
  if (after > 0) {
    cli_report_words(
        run->arguments,
        "%" PRId64
        " springs or contacts ended without a direction, with both ends, or particle and centre, at one place; "
        "they exert no force",
        after);
  }
}

/* Resets everything for another run. */
static int begin_again(struct cli_run *run) {
  hooke_integrator_destroy(run->integrator);
  hooke_options_destroy(run->options);
  hooke_state_destroy(run->setup.state);
  run->integrator = NULL;
  run->options = NULL;
  run->setup.state = NULL;
  run->frames = run->frames_beyond = 0;
  const int32_t status = hooke_state_create(run->setup.system, &run->setup.state);
  return status == HOOKE_OK ? HOOKE_EXIT_DONE : cli_report_status(run->arguments, status);
}

/* Runs; with a wanted error, repeats until it is met or nothing finer is known to help. */
static int integrate_to_want(struct cli_run *run) {
  int code = integrate(run);
  if (!cli_arguments_text(run->arguments, "want")) return code;
  while (code == HOOKE_EXIT_DONE) {
    const int32_t status = cli_want_measure(run);
    if (status != HOOKE_OK && status != HOOKE_STOPPED) return cli_report_status(run->arguments, status);
    if (!cli_want_goes_on(run)) break;
    code = begin_again(run);
    if (code == HOOKE_EXIT_DONE) code = integrate(run);
  }
  return code;
}

/* Reports the error of a run after everything else. */
static void estimate(struct cli_run *run) {
  const int wanted = cli_arguments_text(run->arguments, "want") != NULL;
  const int32_t status = wanted ? HOOKE_OK : cli_want_measure(run);
  if (status == HOOKE_STOPPED)
    cli_report_words(run->arguments, "%s: how wrong the run is is not looked into", cli_force_stop());
  if (status == HOOKE_NO_MEMORY)
    cli_report_words(run->arguments, "out of memory: how wrong the run is is not looked into");
}

/* Writes it into the output, which is complete already. */
static int write_estimate(const struct cli_run *run) {
  if (!run->output || !run->estimate || !cli_want_judges(run) || run->was_finished ||
      run->outcome != HOOKE_OK)
    return HOOKE_EXIT_DONE;
  const int32_t status = hooke_estimate_write_h5(run->estimate, run->output);
  return status == HOOKE_OK ? HOOKE_EXIT_DONE : cli_report_status(run->arguments, status);
}

static int run_and_tell(struct cli_run *run) {
  int code = integrate_to_want(run);
  if (code != HOOKE_EXIT_DONE) return code;
  const int blew_up = cli_exit_code(run->outcome) == HOOKE_EXIT_DIVERGED;
  /* everything is on the disk and printed before the diagnosis; with --json both are one object */
  if (!run->arguments->json) cli_run_print(run);
  if (!blew_up) cli_warnings_tell(run->arguments, run->warnings);
  if (!blew_up && !run->arguments->quiet) tell_coincident(run);
  if (!blew_up && !run->arguments->quiet && run->passages[0])
    cli_report_words(run->arguments, "warning: %s", run->passages);
  if (run->outcome == HOOKE_STOPPED) tell_interrupted(run);
  estimate(run);
  if (!run->arguments->json) cli_want_print(run);
  code = write_estimate(run);
  if (code != HOOKE_EXIT_DONE) return code;
  cli_run_print_final(run);
  if (blew_up) find_why(run);
  if (run->arguments->json) cli_run_print(run);
  if (blew_up && !run->why) cli_warnings_tell(run->arguments, run->warnings);
  if (blew_up) cli_blow_up_tell(run);
  return run->outcome == HOOKE_OK ? cli_want_exit_code(run) : cli_exit_code(run->outcome);
}

/* Everything before the first step. */
static int make_ready(struct cli_run *run) {
  int code = cli_setup_load(run->arguments, &run->setup);
  if (code == HOOKE_EXIT_DONE) code = cli_want_pick(run);
  if (code == HOOKE_EXIT_DONE && !run->resumed) code = cli_setup_fit(run->arguments, &run->setup, 0);
  if (code != HOOKE_EXIT_DONE) return code;
  const int told =
      !run->arguments->quiet && cli_arguments_text(run->arguments, "want"); /* else by the integrator */
  const int32_t status =
      told ? hooke_system_warnings(run->setup.system, cli_warnings_hear, run->warnings) : HOOKE_OK;
  if (status != HOOKE_OK) return cli_report_status(run->arguments, status);
  return cli_setup_require(run->arguments, &run->setup, hooke_options_text(run->setup.options, "method"));
}

static void release(struct cli_run *run) {
  hooke_measurement_destroy(run->why);
  hooke_measurement_destroy(run->estimate);
  hooke_integrator_destroy(run->integrator);
  hooke_options_destroy(run->options);
  hooke_options_destroy(run->probe_options);
  cli_setup_destroy(&run->setup);
}

/* Why the run blew up is looked into when it is shown; a run within this one may have, too. */
static int run_and_show(struct cli_run *run, cli_show *show, void *context) {
  int code = integrate_to_want(run);
  const int blew_up = cli_exit_code(run->outcome) == HOOKE_EXIT_DIVERGED;
  if (!blew_up) cli_warnings_tell(run->arguments, run->warnings);
  code = cli_watch_check(run->arguments, code);
  if (code == HOOKE_EXIT_DONE) code = show(run, context);
  if ((code != HOOKE_EXIT_DONE && code != HOOKE_EXIT_DIVERGED) || !blew_up) return code;
  find_why(run);
  if (!run->why) cli_warnings_tell(run->arguments, run->warnings);
  cli_blow_up_tell(run);
  return cli_exit_code(run->outcome);
}

/* Signals are caught before there is a file to remove. */
int cli_run_to_show(const struct cli_arguments *arguments, char *path, const char *page, double beyond,
                    cli_show *show, void *context) {
  struct cli_run run = {.arguments = arguments, .output = path, .page = page};
  int code = make_ready(&run);
  if (code == HOOKE_EXIT_DONE) code = cli_setup_check_read(arguments, &run.setup, page);
  if (code == HOOKE_EXIT_DONE) {
    cli_watch_start(&run.watch, arguments);
    (void)hooke_options_set_number(run.setup.options, "frames_after", beyond); /* in bounds */
    if (cli_os_make_file(path) == 0) {
      code = run_and_show(&run, show, context);
      unlink(path);
    } else {
      code = cli_report(arguments, HOOKE_EXIT_IO, "%s: cannot write there: %s", page, strerror(errno));
    }
  }
  release(&run);
  return code;
}

/* Reports options that --resume takes from the run itself, and --checkpoint without a file to write it
 * beside. */
static int check_resume(const struct cli_arguments *arguments) {
  const char *file = cli_arguments_text(arguments, "resume");
  if (!file && cli_arguments_text(arguments, "checkpoint") && !cli_arguments_text(arguments, "output")) {
    return cli_report(arguments, HOOKE_EXIT_USAGE,
                      "--checkpoint keeps places to go on from beside the output; give one with -o OUT.h5");
  }
  for (int32_t i = 0; file && i < arguments->count; i++) {
    const struct cli_argument *argument = &arguments->all[i];
    if (!argument->text || cli_is_among(MAY_BE_GIVEN, argument->name)) continue;
    return cli_report(arguments, HOOKE_EXIT_USAGE,
                      "--resume goes on with the scene and the options of %s, so that the bits are those of "
                      "a run that never stopped; leave out --%s",
                      file, argument->flag);
  }
  return HOOKE_EXIT_DONE;
}

static int do_run(const struct cli_arguments *arguments) {
  struct cli_run run = {.arguments = arguments,
                        .output = cli_arguments_text(arguments, "output"),
                        .resumed = cli_arguments_text(arguments, "resume")};
  int code = check_resume(arguments);
  if (code == HOOKE_EXIT_DONE) code = cli_setup_check_ending(arguments, "-o", run.output);
  if (code == HOOKE_EXIT_DONE) code = cli_setup_check_output(arguments, run.output);
  if (code != HOOKE_EXIT_DONE) return code;
  if (run.resumed) run.output = run.resumed;
  code = cli_probes_read(&run);
  if (code == HOOKE_EXIT_DONE) code = make_ready(&run);
  if (code == HOOKE_EXIT_DONE) code = run_and_tell(&run);
  release(&run);
  return code;
}

static const struct cli_verb_row rows[] = {
    {"output", 'o', "FILE.h5",
     "writes the trajectory to FILE.h5 (HDF5 in the H5MD layout), and beside it the .xdmf by which ParaView "
     "reads it, replacing them"},
    {"resume", 0, "OUT.h5",
     "goes on with the run of OUT.h5 where it stopped or was killed, with its own scene and options, as if "
     "it had never stopped; only --threads, --final, --watch, --force, --no-why, --json and --quiet may be "
     "given with it"},
    {"want", 0, "LENGTH",
     "picks a method and its step or tolerance so that no frame is off by more than this (1mm, 1e-4, or a list "
     "such as tip=2mm,line:max.tension=1%,energy=0.1J), runs, "
     "measures the error, and takes a finer one if that is not met; --method restricts the choice"},
    {"probe", 0, "Q,Q",
     "quantities to write over the run into the file of --probes, such as 57.y,line:50.x,energy"},
    {"probe-every", 0, "DT",
     "time between two lines of probes, a whole multiple of a fixed step; that of frames if not given"},
    {"probes", 0, "FILE", "the file of --probe, FILE.csv or FILE.h5, written while the run goes"},
    {"final", 0, NULL, "prints the position [m] and velocity [m/s] of every particle at the end, too"},
    HOOKE_FROM_REST,
    {"watch", 0, "Q,Q",
     "prints quantities at the end, and their smallest and largest values over all steps: 57.y, 57.reaction, "
     "group:3.tension, group:max.tension, energy, period:57.y and others of one grammar"},
    {"strict", 0, NULL,
     "refuses a run without a step, or whose every or duration is "
     "no whole multiple of it, rather than choosing or moving them"},
    {"no-estimate", 0, NULL, "leaves out estimating how wrong the run is"},
    {"no-why", 0, NULL, "leaves out looking into why a run blew up"},
    HOOKE_FORCE,
};

const struct cli_verb cli_verb_run = {
    .name = "run",
    .summary = "integrates a scene",
    .text = "Integrates the scene by one method and prints what came out: time reached, work, energy, "
            "momentum. A run that diverges keeps everything up to then and says what to do. Ctrl-C ends a "
            "run cleanly, and with -o says how to go on with it; --checkpoint keeps places to go on from "
            "that outlast a crash, too.",
    .example = "hooke run cloth.json -o cloth.h5",
    HOOKE_VERB_ROWS(rows),
    .for_scene = "resume",
    .function = do_run,
};
