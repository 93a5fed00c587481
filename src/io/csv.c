/* Tables as CSV, in the same bytes whatever the locale. */
#include "core/keep_errno.h"
#include "core/memory.h"
#include "core/number.h"
#include "hooke/io.h"
#include "io/place.h"
#include "measure/study.h"

#include <errno.h>
#include <math.h>
#include <stdio.h>
#include <unistd.h>

static void write_row(FILE *file, const hooke_study *study, int64_t row) {
  fputs(hooke_study_text(study, row, "method"), file);
  for (int k = 0; k < HOOKE_STUDY_ROW_NUMBERS; k++) {
    const double value = hooke_study_number(study, row, hooke_study_row_number[k]);
    char text[HOOKE_NUMBER_SIZE] = "";
    if (isfinite(value)) hooke_number_print(value, text);
    fprintf(file, ",%s", text);
  }
  fprintf(file, ",%s\n", hooke_study_text(study, row, "status"));
}

static int32_t write_rows(const char *path, const char *temporary, const hooke_study *study) {
  unlink(temporary);
  FILE *file = fopen(temporary, "wx");
  if (file == NULL) return hooke_place_fail(path, "create the file", errno);
  fputs("method", file);
  for (int k = 0; k < HOOKE_STUDY_ROW_NUMBERS; k++)
    fprintf(file, ",%s", hooke_study_row_number[k]);
  fputs(",status\n", file);
  for (int64_t row = 0; row < hooke_study_row_count(study); row++)
    write_row(file, study, row);
  int error = fflush(file) == 0 ? 0 : errno;
  if (error == 0 && ferror(file)) error = EIO; /* an earlier write failed */
  if (fclose(file) != 0 && error == 0) error = errno;
  return error ? hooke_place_fail(path, "write", error) : HOOKE_OK;
}

int32_t hooke_study_write_csv(const hooke_study *study, const char *path) {
  HOOKE_KEEP_ERRNO;
  char *place, *temporary;
  int32_t status = hooke_place_find(path, &place, &temporary);
  if (status == HOOKE_OK) status = write_rows(path, temporary, study);
  if (status == HOOKE_OK) status = hooke_place_take(place, &temporary);
  if (temporary) unlink(temporary);
  hooke_free(temporary);
  hooke_free(place);
  return status;
}
