/* hooke make: writes the scene of one part, from the options of the part. */
#include "describe.h"
#include "os.h"
#include "print.h"
#include "report.h"
#include "setup.h"
#include "watch.h"

#include <inttypes.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

struct make {
  const struct cli_arguments *arguments;
  const char *output; /* NULL: standard output */
  hooke_options *run; /* of `arguments`; NULL: none was given */
  hooke_system *system;
  hooke_scene *scene; /* the scene, written and read again */
};

/* ---- failures, by option ---- */

static int32_t is_missing(const hooke_options *table, int64_t row) {
  const char *family = hooke_options_row(table, row, "family");
  return hooke_options_row_number(table, row, "required") == 1.0 &&
         hooke_options_row(table, row, "default")[0] == '\0' &&
         !hooke_options_is_set(table, hooke_options_row(table, row, "name")) &&
         (family[0] == '\0' || hooke_options_is_set(table, family));
}

/* Lists everything that is missing at once. */
static int check_required(const struct make *make) {
  char list[2 * HOOKE_DOC_SIZE] = "";
  for (int32_t i = 0; i < make->arguments->count; i++) {
    const struct cli_argument *argument = &make->arguments->all[i];
    if (argument->table != make->arguments->of_kind || !is_missing(argument->table, argument->row)) continue;
    const char *unit = hooke_options_row(argument->table, argument->row, "unit");
    const char *example = hooke_options_row(argument->table, argument->row, "example");
    const char *quote = strchr(example, ';') ? "'" : "";
    cli_append(list, sizeof list, "%s--%s (%s%s%s%s)", list[0] ? "; " : "", argument->flag,
               hooke_options_row(argument->table, argument->row, "doc"), unit[0] ? " [" : "", unit,
               unit[0] ? "]" : "");
    if (example[0])
      cli_append(list, sizeof list, ", such as --%s %s%s%s", argument->flag, quote, example, quote);
  }
  if (!list[0]) return HOOKE_EXIT_DONE;
  return cli_report(make->arguments, HOOKE_EXIT_USAGE, "missing: %s", list);
}

/* Row of `table` whose name the message begins with; -1: none. */
static int64_t row_of_message(const hooke_options *table, const char *message) {
  const size_t length = strcspn(message, ":[");
  for (int64_t row = 0; row < hooke_options_row_count(table); row++) {
    const char *name = hooke_options_row(table, row, "name");
    if (strlen(name) == length && strncmp(message, name, length) == 0) return row;
  }
  return -1;
}

/* Reports a failure of the library, whose place is an option; one without place may concern a missing option.
 */
static int report_option(const struct make *make, const hooke_options *table, int32_t status) {
  const char *message = hooke_last_error();
  const int64_t row = row_of_message(table, message);
  char flag[HOOKE_FLAG_SIZE], example[HOOKE_DOC_SIZE];
  if (row < 0 && status == HOOKE_BAD_VALUE) {
    return cli_report(make->arguments, cli_exit_code(status), "%s; for example: %s", message,
                      cli_describe_example(make->arguments, example));
  }
  if (row < 0) return cli_report_status(make->arguments, status);
  const char *name = hooke_options_row(table, row, "name");
  cli_arguments_flag(name, flag);
  return cli_report(make->arguments, cli_exit_code(status), "--%s%s", flag, message + strlen(name));
}

/* ---- creating ---- */

/* Resolves the file of a mesh, so that the scene does not depend on it. */
static int read_file(const struct make *make) {
  hooke_options *part = make->arguments->of_kind;
  if (!hooke_options_is_set(part, "file")) return HOOKE_EXIT_DONE;
  const char *file = hooke_options_text(part, "file");
  const int code = cli_setup_check_apart(make->arguments, file, "the mesh", make->output);
  if (code != HOOKE_EXIT_DONE) return code;
  const int32_t status = hooke_mesh_read(file, part);
  if (status == HOOKE_OK) return HOOKE_EXIT_DONE;
  if (row_of_message(part, hooke_last_error()) >= 0) return report_option(make, part, status);
  return cli_report(make->arguments, cli_exit_code(status), "--file %s", hooke_last_error());
}

static int build(struct make *make) {
  const struct cli_arguments *arguments = make->arguments;
  const char *name = cli_arguments_text(arguments, "name");
  int32_t status = hooke_system_create(&make->system);
  if (status != HOOKE_OK) return cli_report_status(arguments, status);
  status = hooke_scene_options_apply(arguments->more, make->system);
  if (status != HOOKE_OK) return report_option(make, arguments->more, status);
  const int code = read_file(make);
  if (code != HOOKE_EXIT_DONE) return code;
  status = hooke_system_add_part(make->system, arguments->scene, name ? name : arguments->scene,
                                 arguments->of_kind, NULL, NULL);
  if (status == HOOKE_OK) status = hooke_system_commit(make->system);
  return status == HOOKE_OK ? HOOKE_EXIT_DONE : report_option(make, arguments->of_kind, status);
}

/* Times that do not fit each other are detected when a run is created from them. */
static int check_run(const struct make *make) {
  if (!make->run) return HOOKE_EXIT_DONE;
  const char *method = hooke_options_text(make->run, "method");
  hooke_integrator *integrator = NULL;
  if (!hooke_method_is_built(method)) {
    cli_report_words(make->arguments, "warning: %s is not in this build of hooke, which cannot run the scene",
                     method);
    return HOOKE_EXIT_DONE;
  }
  if (hooke_method_is_adaptive(method) == 0 && !hooke_options_is_set(make->run, "step"))
    return HOOKE_EXIT_DONE;
  const int32_t status = hooke_integrator_create(make->system, make->run, &integrator);
  hooke_integrator_destroy(integrator);
  return status == HOOKE_OK ? HOOKE_EXIT_DONE : report_option(make, make->run, status);
}

/* Reads the written text as every verb will. */
static int read_back(struct make *make) {
  const char *name = make->output ? make->output : "standard output";
  const char *slash = make->output ? cli_os_last_slash(make->output) : NULL;
  char *folder = strdup(slash ? make->output : ".");
  if (folder && slash) folder[slash - make->output + 1] = '\0';
  if (!folder) return cli_report(make->arguments, HOOKE_EXIT_BAD_INPUT, "out of memory");
  int32_t status = hooke_scene_of_system(make->system, hooke_options_text(make->arguments->more, "title"),
                                         make->run, name, folder, &make->scene);
  if (status == HOOKE_OK) status = hooke_scene_commit(make->scene);
  free(folder);
  return status == HOOKE_OK ? HOOKE_EXIT_DONE : cli_report_status(make->arguments, status);
}

/* ---- results ---- */

/* Describes the scene; and for a step that was not given, names the commands that find one. */
static void tell(struct make *make) {
  const int64_t particles = hooke_system_particle_count(make->system);
  char warnings[HOOKE_WARNINGS_SIZE] = "";
  if (make->arguments->quiet) return;
  cli_report_words(
      make->arguments, "%s: a %s of %" PRId64 " particles (%" PRId64 " pinned), %" PRId64 " springs",
      make->output ? make->output : "standard output", make->arguments->scene, particles,
      particles - hooke_system_count(make->system, "free"), hooke_system_count(make->system, "springs"));
  const int32_t status = hooke_system_warnings(make->system, cli_warnings_hear, warnings);
  cli_warnings_tell(make->arguments, warnings);
  if (status == HOOKE_NO_MEMORY) cli_report_words(make->arguments, "out of memory: warnings are left out");
  if (!make->output || (make->run && hooke_options_is_set(make->run, "step"))) return;
  fputs("the largest stable steps: hooke limit ", stderr);
  cli_print_quoted(stderr, make->output);
  fputs(" --predict\n", stderr);
}

static int write(const struct make *make) {
  if (!make->output) {
    fputs(hooke_scene_text(make->scene, "text"), stdout);
    return HOOKE_EXIT_DONE;
  }
  const int32_t status = hooke_scene_write(make->output, make->system,
                                           hooke_options_text(make->arguments->more, "title"), make->run);
  if (status != HOOKE_OK) return cli_report_status(make->arguments, status);
  if (make->arguments->json)
    cli_print_json("{'scene': %s, 'kind': %s, 'particles': %" PRId64 ", 'springs': %" PRId64 "}\n",
                   make->output, make->arguments->scene, hooke_system_particle_count(make->system),
                   hooke_system_count(make->system, "springs"));
  return HOOKE_EXIT_DONE;
}

static int do_make(const struct cli_arguments *arguments) {
  struct make make = {.arguments = arguments, .output = cli_arguments_text(arguments, "output")};
  struct cli_watch watch;
  if (make.output && strcmp(make.output, "-") == 0) make.output = NULL;
  if (cli_arguments_has_run(arguments)) make.run = arguments->run;
  cli_watch_start(&watch, arguments);
  int code = make.output ? cli_setup_check_ending(arguments, "-o", make.output) : HOOKE_EXIT_DONE;
  if (code == HOOKE_EXIT_DONE) code = check_required(&make);
  if (code == HOOKE_EXIT_DONE) code = cli_watch_check(arguments, build(&make));
  if (code == HOOKE_EXIT_DONE) code = check_run(&make);
  if (code == HOOKE_EXIT_DONE) code = cli_watch_check(arguments, read_back(&make));
  if (code == HOOKE_EXIT_DONE) code = write(&make);
  if (code == HOOKE_EXIT_DONE) tell(&make);
  hooke_scene_destroy(make.scene);
  hooke_system_destroy(make.system);
  return code;
}

static const struct cli_verb_row own_rows[] = {
    {"output", 'o', "SCENE.json",
     "writes the scene there, replacing it; without it, or with -, to standard output"},
    {"name", 0, "NAME", "name of the part, before those of its spring groups; default: its kind"},
};

const struct cli_verb cli_verb_make = {
    .name = "make",
    .summary = "writes a scene of one part, such as a cloth, from options",
    .text = "Writes a scene of one part. Every key of the part, of the scene and of its run is an option; "
            "those of its springs have the family in front, such as --structural.stiffness. Vectors are "
            "written 0,-9.81,0, several of them 1,0,0;0,0,1 (or the option again), sizes 64x64. Nothing is "
            "written before the scene was built, and read again.",
    .example = "hooke make cloth --size 8x8 --edges '1,0,0;0,0,1' --mass 1 --pinned top-corners "
               "--structural.stiffness 100 "
               "--structural.damping 0.04 --gravity 0,-9.81,0 --step 1ms --duration 0.5 -o cloth.json",
    HOOKE_VERB_ROWS(own_rows),
    .options = "scene",
    .takes_kind = 1,
    .function = do_make,
};
