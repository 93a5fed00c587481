#include "core/status.h"
#include "io/file/inputs.h"
#include "io/measurement/measurement_file.h"

#include <string.h>

static const struct format {
  const char *ending;
  int32_t (*write)(const hooke_measurement *measurement, const char *path);
} formats[] = {{".csv", hk_measurement_write_csv},
               {".json", hk_measurement_write_json},
               {".h5", hk_measurement_write_h5},
               {".html", hk_measurement_write_page}};

static int ends_in(const char *path, const char *ending) {
  const size_t length = strlen(path), end = strlen(ending);
  return length > end && strcmp(path + length - end, ending) == 0;
}

int32_t hooke_measurement_write(const hooke_measurement *measurement, const char *path) {
  if (!measurement->has_run)
    return hk_fail(HOOKE_BAD_CALL, NULL, "there is nothing to write before hooke_measurement_run()");
  const int32_t status = measurement->system ? hk_inputs_refuse(measurement->system, path) : HOOKE_OK;
  if (status != HOOKE_OK) return status;
  if (measurement->kind->write) return measurement->kind->write(measurement, path);
  for (size_t k = 0; k < sizeof formats / sizeof formats[0]; k++) {
    if (ends_in(path, formats[k].ending)) return formats[k].write(measurement, path);
  }
  return hk_fail(HOOKE_BAD_VALUE, "path", "%s: allowed are names that end in .csv, .json, .h5 or .html",
                 path);
}
