/* The check value of a file or a frame: CRC-32 as zlib, gzip and PNG have it (polynomial 0xEDB88320,
 * reflected). It finds every change of up to 32 bits in a row. */
#ifndef HOOKE_CORE_CRC32_H
#define HOOKE_CORE_CRC32_H

#include <stdint.h>

/* Of bytes that follow those whose value is `start` (0: of the first ones). */
uint32_t hk_crc32(uint32_t start, const void *bytes, int64_t count);

#endif
