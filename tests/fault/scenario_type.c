/* Command lines: the program itself, verb by verb, in this process. Its exit code is the status, and its
 * output the result. Scenarios that need a program are not in the lists of builds without one. */
#include "scenarios.h"

#include "check.h"
#include "program.h"

#include <fcntl.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

enum { MOST_WORDS = 40, WORDS_SIZE = 2048, PRINTED_SIZE = 1 << 17 };

/* A word that begins with "@" is a file, in the output folder if it is "out.", otherwise in the input folder.
 */
struct line {
  const char *words;
  int code;               /* its ending */
  int32_t only_code;      /* its output depends on the clock */
  const char *on_failure; /* must not be in the output then; NULL: nothing */
};

static char printed[PRINTED_SIZE], said[PRINTED_SIZE]; /* standard output and standard error */

/* ---- the program ---- */

static int split(const struct attempt *a, const char *line, char *room, char **argv) {
  int argc = 0;
  char *at = room;
  for (const char *word = line; *word && argc < MOST_WORDS; word += strspn(word, " ")) {
    const int length = (int)strcspn(word, " "), is_file = word[0] == '@';
    char name[128];
    argv[argc++] = at;
    snprintf(name, sizeof name, "%.*s", length - is_file, word + is_file);
    at += sprintf(at, "%s", is_file ? path_of(a, name) : name) + 1;
    word += length;
  }
  argv[argc] = NULL;
  return argc;
}

static void read_text(int descriptor, char text[PRINTED_SIZE]) {
  const ssize_t length = pread(descriptor, text, PRINTED_SIZE - 1, 0);
  text[length > 0 ? length : 0] = '\0';
}

static int new_file(const struct attempt *a, const char *name) {
  char path[256];
  snprintf(path, sizeof path, "%s/%s", a->folder, name);
  const int descriptor = open(path, O_RDWR | O_CREAT | O_TRUNC | O_CLOEXEC, 0600);
  assert_true(descriptor >= 0);
  return descriptor;
}

static int run_program(struct attempt *a, const struct line *line) {
  char room[WORDS_SIZE], *argv[MOST_WORDS + 1];
  fault_pause();
  fflush(NULL);
  const int argc = split(a, line->words, room, argv);
  const int out = new_file(a, "printed"), err = new_file(a, "said"), old_out = dup(STDOUT_FILENO),
            old_err = dup(STDERR_FILENO);
  dup2(out, STDOUT_FILENO);
  dup2(err, STDERR_FILENO);
  fault_resume();
  const int code = hooke_program_main(argc, argv);
  fault_pause();
  fflush(NULL);
  clearerr(stdout);
  dup2(old_out, STDOUT_FILENO);
  dup2(old_err, STDERR_FILENO);
  read_text(out, printed);
  read_text(err, said);
  const int all[] = {out, err, old_out, old_err};
  for (int k = 0; k < 4; k++)
    close(all[k]);
  fault_resume();
  return code;
}

/* ---- results ---- */

static int32_t status_of(const struct line *line, int code) {
  if (code == 3 && strstr(said, "memory")) return HOOKE_NO_MEMORY;
  if (code == line->code) return HOOKE_OK;
  return code == 5 ? HOOKE_IO_FAILED : HOOKE_BAD_CALL;
}

/* Another library may have printed something before, if memory was missing at its start. */
static int is_told(void) {
  return strncmp(said, "hooke", 5) == 0 || strstr(said, "\nhooke ") != NULL;
}

/* Standard output, without its times. */
static void take_printed(struct attempt *a) {
  static const char time[] = "\"wall_seconds\": ";
  for (char *at = printed; (at = strstr(at, time)) != NULL;) {
    at += strlen(time);
    memset(at, ' ', strcspn(at, ",}"));
  }
  /* the number of digits varies */
  for (const char *at = printed; *at; at++)
    if (*at != ' ') attempt_number(a, (double)(unsigned char)*at);
}

SCENARIO(type) {
  const struct line *line = with;
  for (int turn = 0; turn < 2; turn++) {
    const int code = run_program(a, line);
    const int32_t status = status_of(line, code);
    if (status == HOOKE_OK) {
      attempt_failed_saying(a, HOOKE_OK, HOOKE_OK, line->words, said);
      break;
    }
    if (line->on_failure && strstr(printed, line->on_failure))
      attempt_wrong(a, "exit code %d, and standard output claims %s", code, line->on_failure);
    if (!is_told()) attempt_wrong(a, "exit code %d without a word: %s", code, said);
    attempt_failed_saying(a, status, HOOKE_OK, line->words, said);
    if (a->gave_up) return;
  }
  attempt_number(a, line->code);
  if (!line->only_code) take_printed(a);
}

/* ---- command lines ---- */

#define LINE(text, ...)                                                                                      \
  &(const struct line) {                                                                                     \
    .words = text, __VA_ARGS__                                                                               \
  }
#define ROPE                                                                                                 \
  "make rope --from 0,0,0 --to 1m,0,0 --segments 4 --mass 0.1 --pinned start --stretch.stiffness 20 "        \
  "--gravity 0,-9.81,0 --step 1ms --duration 1"

const struct scenario typing[] = {
#if HOOKE_HAVE_PROGRAM
    {"type, --version", type, LINE("hooke --version"), 1, NULL, NULL},
    {"type, --help", type, LINE("hooke --help"), 1, NULL, NULL},
    {"type, make --help", type, LINE("hooke make cloth --help"), 1, NULL, NULL},
    {"type, --man", type, LINE("hooke --man"), 25, NULL, NULL},
    {"type, --complete", type, LINE("hooke --complete run --method rk"), 25, NULL, NULL},
    {"type, a word that is no option", type, LINE("hooke run @parts.json --stp 3 --json", .code = 2), 1, NULL,
     NULL},
    {"type, a scene that is wrong", type, LINE("hooke check @wrong.json --json", .code = 3), 1, NULL, NULL},
    {"type, make", type, LINE("hooke " ROPE), 8, NULL, NULL},
    {"type, run", type, LINE("hooke run @parts.json --json --final --no-estimate", .on_failure = "finished"),
     8, NULL, NULL},
    {"type, run with its error, which may be missing", type,
     LINE("hooke run @parts.json --json", .only_code = 1), 8, NULL, NULL},
    {"type, run that diverges", type, LINE("hooke run @stiff.json --json", .code = 4, .only_code = 1), 40,
     "lapack", NULL},
    {"type, run that had finished", type,
     LINE("hooke run --resume @arrays.h5 --json", .on_failure = "finished"), 40, "hdf5", NULL},
    {"type, check", type, LINE("hooke check @springs.json --json", .only_code = 1), 500, "lapack", NULL},
    {"type, limit", type, LINE("hooke limit @parts.json --predict --at @arrays.h5:1 --json"), 40,
     "hdf5 lapack", NULL},
    {"type, why", type, LINE("hooke why @stiff.json"), 40, "lapack", NULL},
    {"type, verify", type, LINE("hooke verify @arrays.h5 --json"), 80, "hdf5", NULL},
    {"type, limit at the last frame so far", type,
     LINE("hooke limit @parts.json --predict --at @midway.h5:-1 --json"), 80, "hdf5 lapack", NULL},
    {"type, verify so far", type, LINE("hooke verify @midway.h5 --json"), 80, "hdf5", NULL},
#endif
    {NULL, NULL, NULL, 0, NULL, NULL},
};

const struct scenario typing_to_files[] = {
#if HOOKE_HAVE_PROGRAM
    {"type, make -o", type, LINE("hooke " ROPE " -o @out.json --json", .on_failure = "kind"), 8, NULL,
     "out.json"},
    {"type, run -o", type,
     LINE("hooke run @parts.json -o @out.h5 --checkpoint 2ms --json --no-estimate", .on_failure = "finished"),
     40, "hdf5", "out.h5 out.xdmf out.h5.checkpoint out.h5.checkpoint.previous"},
    {"type, run that diverges -o", type,
     LINE("hooke run @stiff.json -o @out.h5 --json", .code = 4, .only_code = 1), 60, "hdf5 lapack",
     "out.h5 out.xdmf"},
    {"type, compare -o", type,
     LINE("hooke compare @parts.json --methods verlet -o @out.h5 --json", .only_code = 1), 40,
     "hdf5 sundials", "out.h5"},
    {"type, study -o .csv", type,
     LINE("hooke study @parts.json --methods verlet --points 6 -o @out.csv --json", .only_code = 1), 1000,
     "sundials gsl", "out.csv"},
    {"type, study --report", type,
     LINE("hooke study @parts.json --methods verlet --points 6 --report @out.html", .only_code = 1), 1000,
     "sundials gsl chartjs", "out.html"},
    {"type, limit --report", type, LINE("hooke limit @parts.json --predict --report @out.html --json"), 40,
     "lapack chartjs", "out.html"},
    {"type, needs -o", type, LINE("hooke needs @parts.json --want 1cm -o @out.json --json", .only_code = 1),
     6000, NULL, "out.json"},
    {"type, needs --report", type,
     LINE("hooke needs @parts.json --want 1cm --report @out.html", .only_code = 1), 9000, "chartjs",
     "out.html"},
    {"type, view so far -o", type,
     LINE("hooke view @midway.h5 -o @out.html --json", .on_failure = "frame_stride"), 80,
     "hdf5 chartjs threejs", "out.html"},
    {"type, view -o", type, LINE("hooke view @arrays.h5 -o @out.html --json", .on_failure = "frame_stride"),
     80, "hdf5 chartjs threejs", "out.html"},
#endif
    {NULL, NULL, NULL, 0, NULL, NULL},
};
