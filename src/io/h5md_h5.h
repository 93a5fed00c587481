/* What an H5MD file says of itself, and the springs. Layout (H5MD 1.1):
 *
 *   /h5md                    version [1, 1]; author, creator
 *   /hooke                   attributes version, abi, units, method; `scene`: the text of the scene;
 * `options`: an attribute for each option of the run; `status`: "running" until the file is closed
 *   /hooke/rest_length       [springs]
 *   /particles/<group>       frames (recording_h5.h)
 *   /connectivity/springs    [springs][2] particle numbers
 *   /observables             frames (recording_h5.h)
 *
 * The status is raw data of fixed length, like everything that is written after the first frame: metadata
 * that change in place could be torn when the process is killed. */
#ifndef HOOKE_IO_H5MD_H5_H
#define HOOKE_IO_H5MD_H5_H

#include "hooke/integrator.h"

#include <hdf5.h>

/* Everything but particles and observables. `method`, `options` and `scene_text` may be NULL. Negative on
 * failure. */
herr_t hooke_h5md_describe(hid_t file, const char *method, const hooke_options *options,
                           const char *scene_text);

/* A group `options` with an attribute for each option that has a value. Negative on failure. */
herr_t hooke_h5md_write_options(hid_t where, const hooke_options *options);

/* /connectivity/springs and /hooke/rest_length; the particles group has to be there. */
herr_t hooke_h5md_connect(hid_t file, const hooke_system *system, const char *group);

/* Copies both to another file, in which the particles group has to be there. */
herr_t hooke_h5md_copy(hid_t from, hid_t to, const char *group);

/* Writes /hooke/status: a word for a status of hooke_integrator_run(). */
herr_t hooke_h5md_write_status(hid_t file, int32_t outcome);

#endif
