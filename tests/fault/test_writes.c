/* Fails every call that writes in turn, once and from then on, HDF5's and hooke's own. It checks the status,
 * and a message with the file and the reason; that older files stay or are replaced by whole ones; that
 * reported frames are in the file; and that no other files are left. */
#include "check.h"
#include "file_faults.h"
#include "hash.h"
#include "sanitized.h"
#include "scenarios.h"
#include "sweep.h"

#include <dirent.h>
#include <errno.h>
#include <fcntl.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/stat.h>
#include <unistd.h>

static struct sweep sweep = {.share = 10};
static char folder[160]; /* output folder; scenes are read from that of the sweep */

static const struct fault {
  const char *name;
  int number;
  int32_t cut;
} faults[] = {
    {"no room", ENOSPC, 0}, {"broken", EIO, 0}, {"quota", EDQUOT, 0}, {"cut, then no room", ENOSPC, 1}};

static const struct fault *fault; /* the current fault */

static const char old[] = "what was there before";

/* ---- the folder ---- */

/* True if `name` is one of the `words`, separated by blanks. */
static int is_among(const char *words, const char *name) {
  const size_t length = strlen(name);
  for (const char *at = words; (at = strstr(at, name)) != NULL; at++) {
    if ((at == words || at[-1] == ' ') && (at[length] == ' ' || at[length] == '\0')) return 1;
  }
  return 0;
}

/* Number of files, without those that are allowed. */
static int64_t count_files_but(const char *names) {
  int64_t count = -2; /* the folder itself and its parent */
  DIR *open_folder = opendir(folder);
  assert_non_null(open_folder);
  for (struct dirent *entry; (entry = readdir(open_folder)) != NULL;)
    count += !is_among(names, entry->d_name);
  closedir(open_folder);
  return count;
}

static void put_old(const char *path) {
  FILE *file = fopen(path, "w");
  assert_non_null(file);
  fputs(old, file);
  assert_int_equal(fclose(file), 0);
}

static int is_old(const char *path) {
  char text[sizeof old + 1] = "";
  FILE *file = fopen(path, "r");
  if (file == NULL) return 0;
  const size_t got = fread(text, 1, sizeof text - 1, file);
  fclose(file);
  return got == sizeof old - 1 && strcmp(text, old) == 0;
}

/* Bit by bit, independently of the library. */
static uint32_t crc32_of(FILE *file, int64_t count) {
  uint32_t value = 0xffffffffu;
  for (int64_t k = 0; k < count; k++) {
    value ^= (uint32_t)fgetc(file);
    for (int bit = 0; bit < 8; bit++)
      value = value >> 1 ^ (value & 1 ? 0xedb88320u : 0);
  }
  return ~value;
}

/* The last four bytes are the check value of all bytes before them. */
static int is_whole_checkpoint(const char *path) {
  FILE *file = fopen(path, "r");
  if (file == NULL || fseek(file, 0, SEEK_END) != 0) return 0;
  const int64_t count = ftell(file) - 4;
  rewind(file);
  const uint32_t value = crc32_of(file, count);
  uint32_t there = 0;
  for (int k = 0; k < 4; k++)
    there |= (uint32_t)fgetc(file) << 8 * k;
  fclose(file);
  return count > 0 && there == value;
}

/* A new file is complete or absent; one of probes has whole lines. */
static int is_whole(const char *path, int32_t of_lines) {
  /* lines of CSV end with a flag */
  static const char *const ends[] = {"</html>\n", "</Xdmf>\n", "}\n", ",1\n", ",0\n"};
  char last[16] = "";
  FILE *file = fopen(path, "r");
  if (file == NULL) return 0;
  const size_t got = fseek(file, -9, SEEK_END) == 0 ? fread(last, 1, 9, file) : 0;
  fclose(file);
  for (size_t k = 0; k < sizeof ends / sizeof ends[0]; k++) {
    const size_t length = strlen(ends[k]);
    if (got >= length && memcmp(last + got - length, ends[k], length) == 0) return 1;
  }
  return of_lines && got > 0 && last[got - 1] == '\n';
}

static int64_t open_descriptors(void) {
  int64_t count = 0;
  for (int descriptor = 3; descriptor < 256; descriptor++)
    count += fcntl(descriptor, F_GETFD) >= 0;
  return count;
}

/* ---- one point ---- */

/* Frames that were reported as written are in the file, if it is a trajectory at all. */
static void check_frames(struct attempt *a, const char *path) {
  hooke_record *record = NULL;
  if (hooke_record_open(path, &record) != HOOKE_OK) {
    attempt_wrong(a, "%s cannot be read afterwards: %s", path, hooke_last_error());
    return;
  }
  if (hooke_record_count(record, "frames") < a->committed)
    attempt_wrong(a, "%lld frames were reported, %lld are there", (long long)a->committed,
                  (long long)hooke_record_count(record, "frames"));
  const char *status = hooke_record_text(record, "status");
  /* closing may fail when everything is written and reported */
  if (a->gave_up && strcmp(status, "finished") == 0 && hooke_record_count(record, "frames") < a->planned)
    attempt_wrong(a, "the file says that it is finished");
  for (int64_t k = 0; k < hooke_record_count(record, "frames"); k++) {
    if (hooke_record_check(record, k) != HOOKE_OK) attempt_wrong(a, "frame %lld is damaged", (long long)k);
  }
  hooke_record_close(record);
}

static void look_at_message(struct attempt *a, const char *files, const char *message) {
  char name[64];
  int names_one = 0;
  if (!a->refused) return;
  for (const char *at = files; *at; at += strlen(name), at += strspn(at, " ")) {
    snprintf(name, sizeof name, "%.*s", (int)strcspn(at, " "), at);
    names_one |= strstr(message, name) != NULL;
  }
  if (!names_one || strstr(message, strerror(fault->number)) == NULL)
    attempt_wrong(a, "the message says not what failed and why: %s", message);
}

static int is_trajectory(const struct scenario *scenario) {
  return strstr(scenario->name, "trajectory") || strstr(scenario->name, "type, run");
}

static int is_of_probes(const struct scenario *scenario) {
  return strstr(scenario->name, "probes") != NULL;
}

/* Frames and lines are written when the file has its name, and a second checkpoint when the first exists. */
static int may_fail_later(const struct scenario *scenario) {
  return is_trajectory(scenario) || is_of_probes(scenario) || strstr(scenario->name, "compar") ||
         strstr(scenario->name, "checkpoint");
}

static void look_at_new(struct attempt *a, const struct scenario *scenario, const char *path) {
  if (is_trajectory(scenario)) {
    check_frames(a, path);
    return;
  }
  if (a->gave_up && a->refused == 1 && !may_fail_later(scenario) &&
      strstr(a->message, "though the new file is in place") == NULL)
    attempt_wrong(a, "the file is a new one, and the message does not say so: %s", a->message);
  if (is_of_probes(scenario) && a->reach != FAULT_ONCE) return; /* the rest of a line cannot be taken back */
  if (strstr(path, ".checkpoint") ? !is_whole_checkpoint(path)
                                  : strstr(path, ".h5") == NULL && !is_whole(path, is_of_probes(scenario)))
    attempt_wrong(a, "what is there now is no whole file");
}

static void look_after(struct attempt *a, const struct scenario *scenario, const char *path) {
  char previous[256];
  const int is_there = access(path, F_OK) == 0;
  snprintf(previous, sizeof previous, "%s.previous", path);
  if (!is_there && !is_old(previous) && !is_whole_checkpoint(previous))
    attempt_wrong(a, "what was there before is gone");
  if (count_files_but(scenario->files) > 0) attempt_wrong(a, "something is left beside the file");
  if (is_there && !is_old(path)) look_at_new(a, scenario, path);
}

static void try_point(const struct scenario *scenario, int64_t k, enum fault_reach reach, struct attempt *a) {
  char path[200];
  snprintf(path, sizeof path, "%s/%.*s", folder, (int)strcspn(scenario->files, " "), scenario->files);
  put_old(path);
  const int64_t descriptors = open_descriptors();
  *a = (struct attempt){
      .folder = sweep.folder, .out = folder, .reach = reach, .on_file = 1, .hash = HASH_START};
  file_faults_are(fault->number, fault->cut);
  fault_begin(k, reach);
  scenario->run(a, scenario->with);
  fault_end();
  look_at_message(a, scenario->files, a->message);
  if (k > 0) look_after(a, scenario, path);
  if (open_descriptors() != descriptors) attempt_wrong(a, "a file is still open");
  unlink(path);
  if (count_files_but("") > 0) {
    char command[256];
    snprintf(command, sizeof command, "rm -f %s/*", folder);
    if (system(command) != 0) attempt_wrong(a, "the folder cannot be emptied");
  }
}

/* The program, which writes by the same functions, takes time. */
static void sweep_writers(int32_t with_program) {
  sweep_all(&sweep, writing, try_point);
  sweep_all(&sweep, resuming, try_point);
  if (with_program || getenv("HOOKE_LONG")) sweep_all(&sweep, typing_to_files, try_point);
}

/* A write that takes only half of its bytes has not failed. */
TEST(short_writes_are_gone_on_with) {
  fault = &faults[0];
  file_faults_only_shorten(1);
  sweep_writers(0);
  file_faults_only_shorten(0);
}

TEST(writes_fail) {
  for (size_t k = 0; k < sizeof faults / sizeof faults[0]; k++) {
    fault = &faults[k];
    sweep.first_point = (int32_t)(3 * k); /* different ones for each */
    print_message("-- %s\n", fault->name);
    sweep_writers(k == 0 && !HOOKE_SANITIZED);
  }
}

static int set_up(void **unused) {
  (void)unused;
  hooke_io_own_process();
  if (sweep_open(&sweep) != 0) return -1;
  snprintf(folder, sizeof folder, "%s/out", sweep.folder);
  file_faults_in(folder);
  return mkdir(folder, 0777);
}

static int tear_down(void **unused) {
  (void)unused;
  file_faults_in("");
  return rmdir(folder) == 0 ? sweep_close(&sweep) : -1;
}

AROUND_ALL(set_up, tear_down)
