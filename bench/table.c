#include "table.h"

#include "commit.h"

#include <math.h>
#include <stdio.h>

/* Additions and multiplications of one spring, including those that add its force to both ends. */
static const double OPERATIONS = 20.0, OPERATIONS_OF_DAMPING = 11.0;

/* Memory traffic of a step without caching: positions and velocities in and out, inverse masses in. */
static const double BYTES_OF_PARTICLE = 13.0 * sizeof(double);

enum {
  THREADS,
  PARTICLES,
  SPRINGS,
  DAMPED,
  STEP,
  TURNS,
  NS_MIN,
  NS_MEDIAN,
  STEP_NS,
  PLAIN_MIN,
  PLAIN_MEDIAN,
  RATIO,
  RATE,
  BYTES,
  TRIAD,
  TRIAD_SHARE,
  ROOT_NS,
  ROOT_SHARE,
  ARITHMETIC_NS,
  ARITHMETIC_SHARE,
  DISTANCE,
  ALLOWED,
  COLUMNS
};

/* Columns without a title are in the CSV only, which has all digits. */
static const struct column {
  const char *key, *title, *format;
  int width;
} column[COLUMNS] = {
    [THREADS] = {"threads", "threads", "%.0f", 7},
    [PARTICLES] = {"particles", NULL, NULL, 0},
    [SPRINGS] = {"springs", "springs", "%.0f", 8},
    [DAMPED] = {"damped", NULL, NULL, 0},
    [STEP] = {"step_s", NULL, NULL, 0},
    [TURNS] = {"turns", NULL, NULL, 0},
    [NS_MIN] = {"ns_min", "ns min", "%.3f", 7},
    [NS_MEDIAN] = {"ns_median", "ns median", "%.3f", 9},
    [STEP_NS] = {"step_ns_median", "ns a step", "%.4g", 10},
    [PLAIN_MIN] = {"plain_ns_min", "plain min", "%.3f", 9},
    [PLAIN_MEDIAN] = {"plain_ns_median", "plain median", "%.3f", 12},
    [RATIO] = {"ratio", "ratio", "%.2f", 6},
    [RATE] = {"particle_steps_per_second", "particles/s", "%.3g", 11},
    [BYTES] = {"bytes_per_second", NULL, NULL, 0},
    [TRIAD] = {"triad_bytes_per_second", NULL, NULL, 0},
    [TRIAD_SHARE] = {"triad_share", "of triad", "%.2f", 8},
    [ROOT_NS] = {"root_ns", NULL, NULL, 0},
    [ROOT_SHARE] = {"root_share", "of roots", "%.2f", 8},
    [ARITHMETIC_NS] = {"arithmetic_ns", NULL, NULL, 0},
    [ARITHMETIC_SHARE] = {"arithmetic_share", "of arithmetic", "%.2f", 13},
    [DISTANCE] = {"distance_m", "distance m", "%.1e", 10},
    [ALLOWED] = {"allowed_m", NULL, NULL, 0},
};

static void evaluate(const struct race_row *row, const struct limits *limits, double *value) {
  const double springs = (double)row->springs, own = row->own.median;
  const double evaluations = springs * row->evaluations / own; /* a second */
  const double operations = OPERATIONS + (row->is_damped ? OPERATIONS_OF_DAMPING : 0.0);
  value[THREADS] = row->threads;
  value[PARTICLES] = (double)row->particles;
  value[SPRINGS] = springs;
  value[DAMPED] = row->is_damped;
  value[STEP] = row->step;
  value[TURNS] = row->turns;
  value[NS_MIN] = 1e9 * row->own.least / springs;
  value[NS_MEDIAN] = 1e9 * own / springs;
  value[STEP_NS] = 1e9 * own;
  value[PLAIN_MIN] = 1e9 * row->plain.least / springs;
  value[PLAIN_MEDIAN] = 1e9 * row->plain.median / springs;
  value[RATIO] = row->plain.median / own;
  value[RATE] = (double)row->particles / own;
  value[BYTES] = BYTES_OF_PARTICLE * value[RATE];
  value[TRIAD] = limits->bandwidth;
  value[TRIAD_SHARE] = value[BYTES] / limits->bandwidth;
  value[ROOT_NS] = 1e9 * limits->root;
  value[ROOT_SHARE] = evaluations * limits->root;
  value[ARITHMETIC_NS] = 1e9 * limits->arithmetic;
  value[ARITHMETIC_SHARE] = evaluations * operations * limits->arithmetic;
  value[DISTANCE] = row->distance;
  value[ALLOWED] = row->allowed;
}

/* ---- CSV ---- */

static void print_csv_head(void) {
  printf("date,hooke,commit,compiler,instructions,cpu,cores,l1d_kib,l2_kib,l3_kib,memory_gib,scene,method");
  for (int k = 0; k < COLUMNS; k++)
    printf(",%s", column[k].key);
  printf("\n");
}

static void print_csv_row(const struct machine *m, const struct race_row *row, const double *value) {
  printf("%s,%s,%s,\"%s\",%s,\"%s\",%ld,%.0f,%.0f,%.0f,%.1f,%s,%s", m->date, hooke_version(), BENCH_COMMIT,
         BENCH_COMPILER, hooke_build_fact("instructions"), m->cpu, m->cores, m->l1d, m->l2, m->l3, m->memory,
         row->scene->name, row->method);
  for (int k = 0; k < COLUMNS; k++) {
    printf(",");
    if (!isnan(value[k])) printf("%.10g", value[k]);
  }
  printf("\n");
}

/* ---- words ---- */

static void print_machine(const struct machine *m, const struct race_request *request,
                          const struct limits *limits, const char *line) {
  printf("%shooke %s (%s), %s, loops for %s, %.10s%s", line, hooke_version(), BENCH_COMMIT, BENCH_COMPILER,
         hooke_build_fact("instructions"), m->date, "\n");
  printf("%s%s, %ld cores, caches %.0f, %.0f and %.0f KiB, %.0f GiB\n", line, m->cpu, m->cores, m->l1d, m->l2,
         m->l3, m->memory);
  for (int k = 0; k < request->thread_count; k++) {
    printf("%s%d thread%s: triad %.1f GB/s, square root and division %.3f ns, addition or multiplication "
           "%.4f ns\n",
           line, (int)request->threads[k], request->threads[k] == 1 ? "" : "s", 1e-9 * limits[k].bandwidth,
           1e9 * limits[k].root, 1e9 * limits[k].arithmetic);
  }
}

static void print_cells(enum table_form form, const char *scene, const char *method, const char (*cell)[32]) {
  printf(form == TABLE_MARKDOWN ? "| %s | %s |" : "%-20s %-17s", scene, method);
  for (int k = 0; k < COLUMNS; k++) {
    if (column[k].title == NULL) continue;
    if (form == TABLE_MARKDOWN)
      printf(" %s |", cell[k]);
    else
      printf(" %*s", column[k].width, cell[k]);
  }
  printf("\n");
}

void table_begin(enum table_form form, const struct machine *machine, const struct race_request *request,
                 const struct limits *limits) {
  char cell[COLUMNS][32];
  if (form == TABLE_CSV) {
    print_csv_head();
    return;
  }
  print_machine(machine, request, limits, form == TABLE_MARKDOWN ? "- " : "# ");
  printf("\n");
  for (int k = 0; k < COLUMNS; k++)
    snprintf(cell[k], sizeof cell[k], "%s", column[k].title ? column[k].title : "");
  print_cells(form, "scene", "method", cell);
  for (int k = 0; k < COLUMNS; k++)
    snprintf(cell[k], sizeof cell[k], "---:");
  if (form == TABLE_MARKDOWN) print_cells(form, "---", "---", cell);
}

void table_row(enum table_form form, const struct machine *machine, const struct race_row *row,
               const struct limits *limits) {
  double value[COLUMNS];
  char cell[COLUMNS][32];
  evaluate(row, limits, value);
  if (form == TABLE_CSV) {
    print_csv_row(machine, row, value);
  } else {
    for (int k = 0; k < COLUMNS; k++) {
      if (column[k].title == NULL) continue;
      if (isnan(value[k]))
        snprintf(cell[k], sizeof cell[k], "-");
      else
        snprintf(cell[k], sizeof cell[k], column[k].format, value[k]);
    }
    print_cells(form, row->scene->name, row->method, cell);
  }
  fflush(stdout);
}
