/* Calls of every public function with arguments of every kind, made from the headers: public_calls.inc has
 * the table of functions, and a pool the objects that arguments refer to. */
#pragma once

#include <stdint.h>

union value {
  int64_t whole;
  double number;
  void *address;
  const void *constant;
  void (*callback)(void);
};

enum kind {
  SHORT,
  WHOLE,
  NUMBER,
  TEXT,
  NUMBERS,
  WHOLES,
  OUT_NUMBERS,
  OUT_WHOLES,
  ADDRESS,
  CALLBACK,
  HANDLE,
  MADE
};

struct parameter {
  enum kind kind;
  int32_t may_be_null;
  const char *type, *name; /* type: of a handle, of a callback */
};

enum { MOST_PARAMETERS = 9 };

struct function {
  const char *name;
  int32_t is_status, count;
  void (*call)(const union value *arguments, union value *result);
  union value refusal; /* its result for a bad handle; 0 if it has none */
  struct parameter parameter[MOST_PARAMETERS];
};

extern const struct function *const public_functions;
extern const int32_t public_function_count;

/* ---- objects ---- */

enum { MOST_OBJECTS = 200 };

struct object {
  const char *type;
  const char
      *suits; /* words of names of functions and parameters that it is for, separated by blanks; NULL: none */
  void *address;
};

struct pool {
  int32_t count;
  struct object object[MOST_OBJECTS];
};

/* Fills the pool: systems, options, states, integrators and measurements of each kind, with files in the
 * working folder. */
void pool_begin(struct pool *pool);
/* A trajectory, which belongs to the process that makes it. */
void pool_add_trajectory(struct pool *pool);
/* With a progress callback that stops what takes long. 0 if it has no place, and stays the caller's. */
int32_t pool_add(struct pool *pool, const char *type, const char *suits, void *address);
/* Destroys all objects, those first that depend on others. */
void pool_end(struct pool *pool);
/* By the function of its type. */
void destroy_object(const char *type, void *address);

/* ---- arguments ---- */

/* Number of choices for a parameter; choice 0 is good, if anything is, and 1 is NULL where that is possible.
 * The objects of a pool come after what is bad in any build. */
int32_t choices_of(const struct pool *pool, const struct parameter *parameter);
/* The argument. `made` receives what a function makes. */
void choose(const struct pool *pool, const struct function *function, int32_t parameter, int32_t choice,
            void **made, union value *argument);
/* 1 if the choice is NULL where that is none, of another type, or no object at all. */
int32_t is_bad_handle(const struct parameter *parameter, int32_t choice);
/* 1 if the choice is an object that does not fit the good ones: a state of another size or kind. */
int32_t is_misfit(const struct pool *pool, const struct parameter *parameter, int32_t choice);
