/* Rows of a race as people and programs read them. */
#ifndef BENCH_TABLE_H
#define BENCH_TABLE_H

#include "limits.h"
#include "machine.h"
#include "race.h"

enum table_form { TABLE_TEXT, TABLE_CSV, TABLE_MARKDOWN };

/* The head of the table; of machine and limits the CSV has more in every row. `limits`: one for each number
 * of threads of the request. */
void table_begin(enum table_form form, const struct machine *machine, const struct race_request *request,
                 const struct limits *limits);
/* `limits`: of as many threads as the row has. */
void table_row(enum table_form form, const struct machine *machine, const struct race_row *row,
               const struct limits *limits);

#endif
