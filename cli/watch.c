#include "watch.h"

#include "os.h"
#include "print.h"
#include "report.h"

#include <signal.h>
#include <stdio.h>
#include <unistd.h>

enum { BAR = 24, MINUTE = 60, HOUR = 3600 };

static const double first_after = 1.0; /* [s] shorter work shows no progress */
static const double again_after = 0.2;

static volatile sig_atomic_t interrupted;

static void interrupt(int number) {
  (void)number;
  interrupted = 1;
}

static double seconds_since(const struct timespec *from, const struct timespec *now) {
  return (double)(now->tv_sec - from->tv_sec) + 1e-9 * (double)(now->tv_nsec - from->tv_nsec);
}

void cli_watch_start(struct cli_watch *watch, const struct cli_arguments *arguments) {
  watch->show = !arguments->quiet && isatty(STDERR_FILENO);
  watch->shown = 0;
  clock_gettime(CLOCK_MONOTONIC, &watch->start);
  watch->last = watch->start;
  cli_os_catch_interrupts(interrupt);
}

static void print_left(double seconds) {
  int64_t left = (int64_t)(seconds + 0.5);
  if (left >= HOUR) {
    fprintf(stderr, "%d h %02d min left", (int)(left / HOUR), (int)(left % HOUR / MINUTE));
  } else if (left >= MINUTE) {
    fprintf(stderr, "%d min %02d s left", (int)(left / MINUTE), (int)(left % MINUTE));
  } else {
    fprintf(stderr, "%d s left", (int)left);
  }
}

static void show(struct cli_watch *watch, double done, const char *what, double elapsed) {
  char bar[BAR + 1];
  for (int i = 0; i < BAR; i++)
    bar[i] = (double)i < done * BAR ? '#' : '.';
  bar[BAR] = '\0';
  fputs("\r\033[K", stderr);
  if (what && cli_print_text(stderr, what) > 0) fputc(' ', stderr);
  fprintf(stderr, "%s %3d %%  ", bar, (int)(100.0 * done));
  if (done > 0.0 && elapsed * (1.0 - done) / done < 1e6 * HOUR) print_left(elapsed * (1.0 - done) / done);
  fflush(stderr);
  watch->shown = 1;
}

int32_t cli_watch_progress(double done, const char *what, void *ctx) {
  struct cli_watch *watch = ctx;
  if (interrupted) return 1;
  if (!watch->show) return 0;
  struct timespec now;
  clock_gettime(CLOCK_MONOTONIC, &now);
  double elapsed = seconds_since(&watch->start, &now);
  if (elapsed < first_after || (watch->shown && seconds_since(&watch->last, &now) < again_after)) return 0;
  watch->last = now;
  show(watch, done < 0.0 ? 0.0 : done > 1.0 ? 1.0 : done, what, elapsed);
  return 0;
}

void cli_watch_end(struct cli_watch *watch) {
  if (watch->shown) fputs("\r\033[K", stderr);
  watch->shown = 0;
}

int32_t cli_watch_run(const struct cli_arguments *arguments, hooke_measurement *measurement,
                      hooke_state *state) {
  struct cli_watch watch;
  cli_watch_start(&watch, arguments);
  hooke_measurement_on_progress(measurement, cli_watch_progress, &watch);
  const int32_t status = hooke_measurement_run(measurement, state);
  hooke_measurement_on_progress(measurement, NULL, NULL);
  cli_watch_end(&watch);
  return status;
}

int cli_watch_measure(const struct cli_arguments *arguments, const char *kind, const struct cli_setup *setup,
                      hooke_state *state, hooke_measurement **made, int32_t *outcome) {
  *outcome = hooke_measurement_create(kind, setup->system, setup->options, arguments->more, made);
  if (*outcome == HOOKE_OK) *outcome = cli_watch_run(arguments, *made, state);
  return *outcome >= 0 ? HOOKE_EXIT_DONE : cli_report_status(arguments, *outcome);
}

int32_t cli_watch_interrupted(void) {
  return interrupted != 0;
}

int cli_watch_check(const struct cli_arguments *arguments, int code) {
  if (!interrupted || code != HOOKE_EXIT_DONE) return code;
  return cli_report(arguments, HOOKE_EXIT_INTERRUPTED, "interrupted; nothing is written");
}
