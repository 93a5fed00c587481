#include "blame.h"

#include <stddef.h>

void hooke_blame_json(struct hooke_json *json, const char *force, double first, double second,
                      const char *group, double share) {
  hooke_json_open(json, NULL, '{');
  if (force[0]) {
    hooke_json_text(json, "spring", NULL);
  } else {
    hooke_json_open(json, "spring", '[');
    hooke_json_count(json, NULL, (int64_t)first);
    hooke_json_count(json, NULL, (int64_t)second);
    hooke_json_close(json);
  }
  hooke_json_text(json, "group", group);
  hooke_json_number(json, "share", share);
  if (force[0]) hooke_json_text(json, "force", force);
  hooke_json_close(json);
}
