#include "machine.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/utsname.h>
#include <time.h>
#include <unistd.h>

/* The value of "name : value" if `line` has that name, without the end of the line; else NULL. */
static const char *value_of(char *line, const char *name) {
  const size_t length = strlen(name);
  char *value = strchr(line, ':');
  if (value == NULL || strncmp(line, name, length) != 0 || strchr("\t :", line[length]) == NULL) return NULL;
  value[strcspn(value, "\n")] = '\0';
  return value + 1 + strspn(value + 1, " ");
}

/* Names of virtual machines are unspecific ("AMD EPYC"), so family and model are added. */
static void read_cpu(char *cpu, size_t size) {
  char line[256], name[64] = "", family[16] = "", model[16] = "";
  struct utsname system;
  FILE *file = fopen("/proc/cpuinfo", "r");
  while (file && fgets(line, sizeof line, file) && strcmp(line, "\n") != 0) {
    const char *value;
    if ((value = value_of(line, "model name")) != NULL)
      snprintf(name, sizeof name, "%.63s", value);
    else if ((value = value_of(line, "cpu family")) != NULL)
      snprintf(family, sizeof family, "%.15s", value);
    else if ((value = value_of(line, "model")) != NULL)
      snprintf(model, sizeof model, "%.15s", value);
  }
  if (file) fclose(file);
  if (name[0])
    snprintf(cpu, size, "%s, family %s model %s", name, family, model);
  else
    snprintf(cpu, size, "%.100s", uname(&system) == 0 ? system.machine : "unknown");
}

/* The word in a file of the first core's caches; "" if there is none. */
static void read_word(int index, const char *name, char *word) {
  char path[96];
  snprintf(path, sizeof path, "/sys/devices/system/cpu/cpu0/cache/index%d/%s", index, name);
  FILE *file = fopen(path, "r");
  word[0] = '\0';
  if (file == NULL) return;
  if (fscanf(file, "%31s", word) != 1) word[0] = '\0';
  fclose(file);
}

static void read_caches(struct machine *machine) {
  double *const size[] = {&machine->l1d, &machine->l2, &machine->l3};
  char level[32], type[32], kibibytes[32];
  for (int index = 0; index < 8; index++) {
    read_word(index, "level", level);
    read_word(index, "type", type);
    read_word(index, "size", kibibytes);
    const long number = strtol(level, NULL, 10);
    if (number >= 1 && number <= 3 && strcmp(type, "Instruction") != 0) {
      *size[number - 1] = strtod(kibibytes, NULL);
    }
  }
}

void machine_read(struct machine *machine) {
  const time_t now = time(NULL);
  struct tm utc;
  memset(machine, 0, sizeof *machine);
  read_cpu(machine->cpu, sizeof machine->cpu);
  read_caches(machine);
  machine->cores = sysconf(_SC_NPROCESSORS_ONLN);
#ifdef _SC_PHYS_PAGES
  machine->memory =
      (double)sysconf(_SC_PHYS_PAGES) * (double)sysconf(_SC_PAGESIZE) / (1024.0 * 1024.0 * 1024.0);
#endif
  if (gmtime_r(&now, &utc)) strftime(machine->date, sizeof machine->date, "%Y-%m-%dT%H:%M:%SZ", &utc);
}
