/* The line of a scene that a message is about. */
#ifndef HOOKE_CLI_EXCERPT_H
#define HOOKE_CLI_EXCERPT_H

#include <stdio.h>

/* For a message that begins with "PATH:LINE:COLUMN: ", with that path, prints the line, shortened, and a
 * caret under its column (in characters). Prints nothing for another message or an unreadable file. Of a
 * trajectory it is the line of its scene. Changes the library's last error. */
void cli_excerpt_print(FILE *file, const char *path, const char *message);

#endif
