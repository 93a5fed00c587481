/* HTML pages: a common frame, filled with the body, the scripts and the data of one page. */
#ifndef HOOKE_IO_PAGE_REPORT_H
#define HOOKE_IO_PAGE_REPORT_H

#include "io/file/text.h"

struct hk_report {
  const char *more;  /* a file of scripts that it shares with another; NULL: none */
  const char *name;  /* its files in share/hooke: <name>.html, <name>.js, <name>_tables.js */
  const char *scene; /* its heading */
  void (*add_data)(struct hk_text *data, const void *ctx); /* adds its keys to a JSON object */
  const void *ctx;
};

/* Writes the page. HOOKE_IO_FAILED, HOOKE_NO_MEMORY, HOOKE_NOT_BUILT. */
int32_t hk_report_write(const struct hk_report *report, const char *path);

/* Adds date, machine and versions. */
void hk_report_add_facts(struct hk_text *data);

#endif
