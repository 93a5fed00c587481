/* SHA-256 (FIPS 180-4). */
#ifndef HOOKE_CLI_DIGEST_H
#define HOOKE_CLI_DIGEST_H

#include <stdint.h>

/* Writes that of a file as 64 hexadecimal digits. Returns 0 if it cannot be read. */
int32_t cli_digest_file(const char *path, char digest[65]);

#endif
