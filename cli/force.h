/* --force: a force that a shared library brings. */
#pragma once

#include "arguments.h"

enum { HOOKE_DIGEST_SIZE = 65 };

struct cli_force {
  hooke_force *function; /* NULL: none */
  char *file;            /* for free() */
  const char *name;
  char digest[HOOKE_DIGEST_SIZE];
};

/* Loads what --force names, if it was given, and sets it as the force of the open system, which it has to
 * outlive. What is wrong is reported, and the exit code returned. */
int cli_force_open(const struct cli_arguments *arguments, hooke_system *system, struct cli_force *force);

/* Writes the SHA-256 of a file as hexadecimal digits. Returns 0 if it cannot be read. */
int32_t cli_digest_file(const char *path, char digest[HOOKE_DIGEST_SIZE]);
