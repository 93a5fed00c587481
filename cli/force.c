#include "force.h"
#include "os.h"
#include "report.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>

static const char OWN_NAME[] = "hooke_own_force", ABI_NAME[] = "hooke_own_force_abi";

static int32_t call(int64_t n, double t, const double *q, const double *v, double *force, void *ctx) {
  const struct cli_force *own = ctx;
  const int32_t value = own->function(n, t, q, v, force, NULL);
  if (value != 0) cli_force_fail(own->file, value);
  return value;
}

static int load(const struct cli_arguments *arguments, struct cli_force *force) {
  const char *const name[2] = {ABI_NAME, force->name};
  void *symbol[2] = {NULL, NULL};
  const int is_read = !cli_os_is_other_than_file(force->file) && cli_digest_file(force->file, force->digest);
  const char *why = is_read ? cli_os_load(force->file, name, symbol) : "it cannot be read";
  const int32_t *abi = symbol[0];
  memcpy(&force->function, &symbol[1], sizeof symbol[1]); /* C has no cast from one to the other */
  if (why && !why[0])
    return cli_report(arguments, HOOKE_EXIT_NOT_BUILT, "--force: this build of hooke loads no libraries");
  if (why)
    return cli_report(arguments, HOOKE_EXIT_BAD_INPUT, "--force %s: is no library to load: %s", force->file,
                      why);
  if (abi && *abi != hooke_abi())
    return cli_report(arguments, HOOKE_EXIT_BAD_INPUT,
                      "--force %s: is for the ABI %d, by its %s, and this hooke has %d; build it again",
                      force->file, (int)*abi, ABI_NAME, (int)hooke_abi());
  if (abi && force->function) return HOOKE_EXIT_DONE;
  return cli_report(arguments, HOOKE_EXIT_BAD_INPUT, "--force %s: has no symbol '%s', %s", force->file,
                    abi ? force->name : ABI_NAME,
                    abi ? "the function of the force" : "an int32_t that is HOOKE_ABI");
}

int cli_force_open(const struct cli_arguments *arguments, hooke_system *system, struct cli_force *force) {
  const char *given = cli_arguments_text(arguments, "force");
  if (!given) return HOOKE_EXIT_DONE;
  if (cli_arguments_text(arguments, "from-rest"))
    return cli_report(
        arguments, HOOKE_EXIT_USAGE,
        "--from-rest makes the scene anew, and no scene holds the force of --force; leave out one");
  const size_t size = strlen(given) + 3;
  force->file = calloc(size, 1);
  if (!force->file) return cli_report(arguments, HOOKE_EXIT_BAD_INPUT, "out of memory");
  /* a loader looks for a name without a slash elsewhere */
  snprintf(force->file, size, "%s%s", cli_os_last_slash(given) ? "" : "./", given);
  char *colon = strrchr(force->file, ':'); /* in paths of Windows a slash follows */
  force->name = colon && !cli_os_last_slash(colon) ? colon + 1 : OWN_NAME;
  if (force->name != OWN_NAME) *colon = '\0';
  const int code = load(arguments, force);
  if (code != HOOKE_EXIT_DONE) return code;
  int32_t status = hooke_system_set_force(system, call, NULL, force);
  if (status == HOOKE_OK) status = hooke_system_name_force(system, force->file, force->name, force->digest);
  if (status != HOOKE_OK) return cli_report_status(arguments, status);
  if (!arguments->quiet)
    cli_report_words(arguments, "force %s of %s, SHA-256 %s", force->name, force->file, force->digest);
  return HOOKE_EXIT_DONE;
}
