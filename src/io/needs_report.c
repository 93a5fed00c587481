/* The page of what a scene needs: what it shows, as JSON. */
#include "hooke/io.h"
#include "io/report.h"

int32_t hooke_needs_write_report(const hooke_needs *needs, const char *path, const char *scene,
                                 const char *command) {
  (void)needs, (void)path, (void)scene, (void)command;
  return HOOKE_NOT_BUILT;
}
