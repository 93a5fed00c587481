/* System calls on files of one folder that fail by plan: these functions replace those of the system for the
 * whole process, including HDF5. */
#pragma once

#include <stdint.h>

/* Affects files whose path begins with `folder`, if they are opened for writing. */
void file_faults_in(const char *folder);

/* Failure at a point: this errno; a write may first be cut to half (`short_first`), and the next one then
 * fails. */
void file_faults_are(int error, int32_t short_first);

/* Fails writes, opening, allocation, truncation, syncing, renaming and closing; otherwise writes are only cut
 * short, which is no failure. */
void file_faults_only_shorten(int32_t only);
