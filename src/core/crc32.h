/* Check value of a file or a frame: CRC-32 as in zlib, gzip and PNG (polynomial 0xEDB88320, reflected). It
 * detects every change of up to 32 consecutive bits. */
#pragma once

#include <stdint.h>

/* CRC-32 of `size` bytes, continued from `start` (0: a new one). */
uint32_t hk_crc32(uint32_t start, const void *bytes, int64_t count);
