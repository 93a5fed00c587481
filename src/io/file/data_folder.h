/* Files installed with the library, in share/hooke. */
#ifndef HOOKE_IO_FILE_DATA_FOLDER_H
#define HOOKE_IO_FILE_DATA_FOLDER_H

#include "io/file/text.h"

/* Appends the contents of share/hooke/<name> to `text`. HOOKE_NOT_BUILT if the file does not exist,
 * HOOKE_IO_FAILED, HOOKE_NO_MEMORY. */
int32_t hk_data_folder_read(const char *name, struct hk_text *text);

#endif
