/* Rows of a race in words and as CSV. */
#pragma once

#include "limits.h"
#include "machine.h"
#include "race.h"

enum table_form { TABLE_TEXT, TABLE_CSV, TABLE_MARKDOWN };

/* The head of the table; the CSV has the facts of machine and limits in every row. `limits`: one for each
 * number of threads of the request. */
void table_begin(enum table_form form, const struct machine *machine, const struct race_request *request,
                 const struct limits *limits);
/* `limits`: for the number of threads of the row. */
void table_row(enum table_form form, const struct machine *machine, const struct race_row *row,
               const struct limits *limits);
