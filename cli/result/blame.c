#include "blame.h"

#include <stddef.h>

void cli_blame_json(struct cli_json *json, const char *force, double first, double second, const char *group,
                    double share) {
  cli_json_open(json, NULL, '{');
  if (force[0]) {
    cli_json_text(json, "spring", NULL);
  } else {
    cli_json_open(json, "spring", '[');
    cli_json_count(json, NULL, (int64_t)first);
    cli_json_count(json, NULL, (int64_t)second);
    cli_json_close(json);
  }
  cli_json_text(json, "group", group);
  cli_json_number(json, "share", share);
  if (force[0]) cli_json_text(json, "force", force);
  cli_json_close(json);
}
