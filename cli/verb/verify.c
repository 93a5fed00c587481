/* hooke verify: checks that a slice of a result reproduces from its scene. */
#include "measured.h"
#include "print.h"
#include "report.h"
#include "setup.h"
#include "watch.h"

#include <math.h>
#include <stdio.h>
#include <string.h>

enum { INDENT = 14 };

static const char *text(const hooke_measurement *verify, const char *what) {
  const char *found = hooke_measurement_text(verify, "verify", 0, what);
  return found ? found : "";
}

/* ---- the certificate ---- */

static void print_makers(const hooke_measurement *verify, const char *head, const char *suffix) {
  static const char *const facts[][2] = {{"version", "hooke"},   {"sundials", "SUNDIALS"},
                                         {"cholmod", "CHOLMOD"}, {"blas", ""},
                                         {"instructions", ""},   {"machine", ""}};
  printf("%-13s", head);
  const char *joint = " ";
  for (size_t k = 0; k < sizeof facts / sizeof facts[0]; k++) {
    char what[32];
    snprintf(what, sizeof what, "%s%s", facts[k][0], suffix);
    if (text(verify, what)[0] == '\0') continue;
    cli_say("%s%s%s%s", joint, facts[k][1], facts[k][1][0] ? " " : "", text(verify, what));
    joint = ", ";
  }
  printf("\n");
}

static void print_step(const hooke_measurement *verify) {
  cli_say("%-13s %s", "method", text(verify, "method"));
  if (isnan(cli_number(verify, "verify", "step"))) {
    printf(", rtol %g, atol %g m\n", cli_number(verify, "verify", "rtol"),
           cli_number(verify, "verify", "atol"));
    return;
  }
  printf(", step %g s", cli_number(verify, "verify", "step"));
  if (isinf(cli_number(verify, "verify", "step_limit")))
    printf(", which nothing limits");
  else if (!isnan(cli_number(verify, "verify", "step_share")))
    printf(", %.3g %% of the longest stable one, %.4g s", 100.0 * cli_number(verify, "verify", "step_share"),
           cli_number(verify, "verify", "step_limit"));
  printf("\n");
}

static void print_words(const struct cli_arguments *arguments, const hooke_measurement *verify) {
  cli_say("%-13s %s\n", "file", arguments->scene);
  cli_say("%-13s %s\n", "run", text(verify, "run"));
  print_makers(verify, "made by", "");
  print_makers(verify, "verified by", "_here");
  print_step(verify);
  printf("%-13s %.0f of %.0f by their check values; %08lx is that of the scene\n", "frames",
         cli_number(verify, "verify", "frames_checked"), cli_number(verify, "verify", "frames"),
         (unsigned long)cli_number(verify, "verify", "check_scene"));
  if (strcmp(text(verify, "parts"), "checked") == 0)
    printf("%-13s scene, options, masses, springs, outcome and error by their check values\n", "the rest");
  cli_claims_print(arguments, verify, INDENT, NULL);
}

/* ---- the verb ---- */

static int verify_with(const struct cli_arguments *arguments, const hooke_system *system) {
  hooke_measurement *verify = NULL;
  int32_t status = system ? hooke_verify_create_with(arguments->scene, system, arguments->more, &verify)
                          : hooke_verify_create(arguments->scene, arguments->more, NULL, &verify);
  if (status != HOOKE_OK) return cli_report_status(arguments, status);
  status = cli_watch_run(arguments, verify, NULL);
  const char *verdict = hooke_measurement_text(verify, "verify", 0, "verdict");
  int code = cli_exit_code(status);
  if (verdict && arguments->json) { /* with the message */
    if (cli_claims_print_json(arguments, "file", verify) != HOOKE_OK)
      code = cli_report_missing_words(arguments);
  } else {
    if (status != HOOKE_OK) code = cli_report_status(arguments, status);
    if (verdict && status != HOOKE_STOPPED) print_words(arguments, verify);
  }
  hooke_measurement_destroy(verify);
  return code;
}

static int do_verify(const struct cli_arguments *arguments) {
  if (cli_setup_is_scene(arguments->scene))
    return cli_report(arguments, HOOKE_EXIT_BAD_INPUT,
                      "%s is a scene; verify takes the output of 'hooke run -o'", arguments->scene);
  struct cli_setup setup = {.scene = NULL};
  int code = cli_arguments_text(arguments, "force") ? cli_setup_load(arguments, &setup) : HOOKE_EXIT_DONE;
  if (code == HOOKE_EXIT_DONE) code = verify_with(arguments, setup.system);
  cli_setup_destroy(&setup);
  return code;
}

static const struct cli_verb_row rows[] = {
    HOOKE_FORCE,
};

const struct cli_verb cli_verb_verify = {
    .name = "verify",
    .input = "OUT.h5",
    .summary = "runs a slice of a result again and compares bits",
    .text =
        "Checks a trajectory of 'hooke run -o' against the scene stored in it: every frame must match its "
        "check value, the first one must be the scene's, and a slice that is run again from the frame before "
        "it must give the same bits. Takes the balance of energy along the slice, runs it once more with "
        "half the step for an estimate of the error, and prints a certificate. An error-controlled method is "
        "run from the start. Exit code 3 says that the file is not what its scene gives.",
    .example = "hooke verify cloth.h5",
    HOOKE_VERB_ROWS(rows),
    .options = "verify",
    .function = do_verify,
};
