#include "force.h"

#include "digest.h"
#include "os.h"
#include "report.h"

#include <ctype.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

static const char OWN_NAME[] = "hooke_own_force", ABI_NAME[] = "hooke_own_force_abi";

static char failure[512]; /* of the force of this program, which has one at most */

int32_t cli_force_failed(void) {
  return failure[0] != '\0';
}

const char *cli_force_stop(void) {
  return failure[0] ? failure : "interrupted";
}

static int32_t call(int64_t n, double t, const double *q, const double *v, double *force, void *ctx) {
  const struct cli_force *own = ctx;
  const int32_t value = own->function(n, t, q, v, force, NULL);
  if (value != 0) snprintf(failure, sizeof failure, "the force of %s returned %d", own->file, (int)value);
  return value;
}

/* NAME follows the last colon, unless that belongs to a path of Windows. */
static char *split_name(char *text) {
  char *colon = strrchr(text, ':');
  if (!colon || colon == text || !(isalpha((unsigned char)colon[1]) || colon[1] == '_')) return NULL;
  for (const char *at = colon + 1; *at; at++)
    if (!isalnum((unsigned char)*at) && *at != '_') return NULL;
  *colon = '\0';
  return colon + 1;
}

static int open_library(const struct cli_arguments *arguments, struct cli_force *force) {
  const char *why = "";
  const size_t size = strlen(force->file) + 3;
  char *path = malloc(size); /* a loader looks for a name without a slash elsewhere */
  if (!path) return cli_report(arguments, HOOKE_EXIT_BAD_INPUT, "out of memory");
  snprintf(path, size, "%s%s", cli_os_last_slash(force->file) ? "" : "./", force->file);
  if (!cli_os_is_other_than_file(path) && cli_digest_file(path, force->digest))
    force->library = cli_os_load(path, &why);
  free(path);
  if (force->library) return HOOKE_EXIT_DONE;
  if (!why)
    return cli_report(arguments, HOOKE_EXIT_NOT_BUILT, "--force: this build of hooke loads no libraries");
  return cli_report(arguments, HOOKE_EXIT_BAD_INPUT, "--force %s: %s%s", force->file,
                    why[0] ? "is no library that can be loaded: " : "cannot be read", why);
}

static int find_function(const struct cli_arguments *arguments, struct cli_force *force) {
  const int32_t *abi = cli_os_symbol(force->library, ABI_NAME);
  void *found = cli_os_symbol(force->library, force->name);
  if (abi && *abi != hooke_abi())
    return cli_report(arguments, HOOKE_EXIT_BAD_INPUT,
                      "--force %s: is for the ABI %d, by its %s, and this hooke has %d; build it again",
                      force->file, (int)*abi, ABI_NAME, (int)hooke_abi());
  if (!abi || !found)
    return cli_report(arguments, HOOKE_EXIT_BAD_INPUT, "--force %s: has no symbol '%s', %s", force->file,
                      abi ? force->name : ABI_NAME,
                      abi ? "the function of the force" : "an int32_t with the ABI number, HOOKE_ABI");
  memcpy(&force->function, &found, sizeof found); /* C has no cast from one to the other */
  return HOOKE_EXIT_DONE;
}

int cli_force_open(const struct cli_arguments *arguments, hooke_system *system, struct cli_force *force) {
  const char *given = cli_arguments_text(arguments, "force");
  if (!given) return HOOKE_EXIT_DONE;
  if (cli_arguments_text(arguments, "from-rest"))
    return cli_report(
        arguments, HOOKE_EXIT_USAGE,
        "--from-rest makes the scene anew, and no scene holds the force of --force; leave out one");
  force->file = strdup(given);
  if (!force->file) return cli_report(arguments, HOOKE_EXIT_BAD_INPUT, "out of memory");
  const char *name = split_name(force->file);
  force->name = name ? name : OWN_NAME;
  int code = open_library(arguments, force);
  if (code == HOOKE_EXIT_DONE) code = find_function(arguments, force);
  if (code != HOOKE_EXIT_DONE) return code;
  int32_t status = hooke_system_set_force(system, call, NULL, force);
  if (status == HOOKE_OK) status = hooke_system_name_force(system, force->file, force->name, force->digest);
  if (status != HOOKE_OK) return cli_report_status(arguments, status);
  if (!arguments->quiet)
    cli_report_words(arguments, "force %s of %s, SHA-256 %s", force->name, force->file, force->digest);
  return HOOKE_EXIT_DONE;
}

void cli_force_close(struct cli_force *force) {
  if (force->library) cli_os_unload(force->library);
  free(force->file);
}
