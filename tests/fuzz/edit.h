/* Meaning of an input for the targets that read HDF5 files: which calls to make, and a list of edits, which
 * are applied to a valid container before hooke reads it. Any bytes have a meaning. */
#pragma once

#include <stddef.h>
#include <stdint.h>

enum { MOST_EDITS = 12, EDIT_BYTES = 12, EDIT_HEAD = 4 };

/* Edits of the set of objects come first: a container without values is created once for them and cached. */
enum edit_kind {
  EDIT_DELETE,    /* the link */
  EDIT_ARRAY,     /* replaces it by an array of another type, shape, layout */
  EDIT_TEXT,      /* replaces it by a text */
  EDIT_GROUP,     /* replaces it by a group */
  EDIT_TYPE,      /* replaces it by a named type */
  EDIT_SOFT,      /* replaces it by a link to another name */
  EDIT_EXTERNAL,  /* replaces it by a link into another file */
  EDIT_HARD,      /* another object replaces it */
  EDIT_RENAME,    /* renames it to an unused name */
  EDIT_ATTRIBUTE, /* an option of the run, or another attribute, of another type, shape, value */
  EDIT_STRUCTURES,
  EDIT_VALUE = EDIT_STRUCTURES, /* one number of an array, or one character of a text */
  EDIT_EXTENT,                  /* the claimed size of an array, and its allocated size in the file */
  EDIT_CHECKS,
  EDIT_CHECK = EDIT_CHECKS, /* makes the check value of a frame match its contents */
  EDIT_KINDS
};

struct edit {
  uint8_t kind, where, what, how;
  uint64_t value;
};

struct edits {
  uint8_t head[EDIT_HEAD]; /* for the target */
  int32_t count;
  struct edit edit[MOST_EDITS]; /* structures, values, checks, each in their order */
};

void edits_decode(const uint8_t *data, size_t size, struct edits *edits);

/* A double from a list of interesting values. */
double edit_double(uint64_t drawn);

/* For LLVMFuzzerCustomMutator: keeps the list well-formed. */
size_t edits_mutate(uint8_t *data, size_t size, size_t most, unsigned seed);
