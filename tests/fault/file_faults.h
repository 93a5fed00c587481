/* System calls on files of one folder that fail by plan: the functions here take the place of those of the
 * system for the whole process, HDF5 included, whatever they are called by. */
#ifndef FAULT_FILE_FAULTS_H
#define FAULT_FILE_FAULTS_H

#include <stdint.h>

/* Files whose path begins with `folder` are concerned, if they are opened for writing. */
void file_faults_in(const char *folder);

/* How a point fails: with this errno; a write may be cut to half before (`short_first`), and then fails with
 * the next. */
void file_faults_are(int error, int32_t short_first);

/* Fails writes, opening, room, cutting, syncing, renaming and closing; else writes alone are cut short, which
 * is no failure. */
void file_faults_only_shorten(int32_t only);

#endif
