/* What the bytes of an input mean to the targets that read HDF5 files: which calls to make, and a list of
 * edits, which are applied to a valid container before hooke reads it. Any bytes mean something. */
#ifndef TESTS_FUZZ_EDIT_H
#define TESTS_FUZZ_EDIT_H

#include <stddef.h>
#include <stdint.h>

enum { MOST_EDITS = 12, EDIT_BYTES = 12, EDIT_HEAD = 4 };

/* Those that change which objects there are come first: a container without values is made once for them and
 * kept. */
enum edit_kind {
  EDIT_DELETE,    /* the link */
  EDIT_ARRAY,     /* an array of another type, shape, layout in its place */
  EDIT_TEXT,      /* a text there */
  EDIT_GROUP,     /* a group there */
  EDIT_TYPE,      /* a named type there */
  EDIT_SOFT,      /* a link to another name there */
  EDIT_EXTERNAL,  /* a link into another file there */
  EDIT_HARD,      /* another object there */
  EDIT_RENAME,    /* to a name that nobody looks for */
  EDIT_ATTRIBUTE, /* an option of the run, or another attribute, of another type, shape, value */
  EDIT_STRUCTURES,
  EDIT_VALUE = EDIT_STRUCTURES, /* one number of an array, or one character of one text */
  EDIT_EXTENT,                  /* the claimed size of an array, and of its room in the file */
  EDIT_CHECKS,
  EDIT_CHECK = EDIT_CHECKS, /* the check value of a frame is made to fit what is there now */
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

/* A double that is worth trying. */
double edit_double(uint64_t drawn);

/* For LLVMFuzzerCustomMutator: keeps the list a list. */
size_t edits_mutate(uint8_t *data, size_t size, size_t most, unsigned seed);

#endif
