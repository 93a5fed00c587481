/* Metadata and springs of an H5MD file. Layout (H5MD 1.1):
 *
 *   /h5md                    version [1, 1]; author, creator
 *   /hooke                   attributes version, abi, sundials, cholmod, blas, instructions, machine, units,
 *                            method, `callbacks` (model/callbacks.h), of a single run `run`, which no other
 *                            run has; `scene`: the text of the scene; `options`: an attribute for each
 *                            option of the run; `status`: "running" until the file is closed
 *   /hooke/rest_length       [springs]
 *   /hooke/file_check        [1] check value of everything but the frames (outcome.h)
 *   /hooke/beyond            of a single run: the first frame after it diverged; -1: there is none
 *   /hooke/error             of a single run: HOOKE_ERROR_COUNT numbers, NaN until they are known; texts
 *                            `error_by`, `error_reason`
 *   /particles/<group>       frames (frames_h5.h)
 *   /connectivity/springs    [springs][2] particle numbers
 *   /observables             frames (frames_h5.h)
 *
 * What is written after the first frame is raw data of fixed length (outcome.h). */
#pragma once

#include "hooke/integrator.h"
#include "io/trajectory/frames_h5.h"
#include "io/trajectory/outcome.h"

#include <hdf5.h>

/* Writes everything but particles and observables. `system`, `method`, `options` and `scene_text` may be
 * NULL. Negative on failure. */
herr_t hk_h5md_describe(hid_t file, const hooke_system *system, const char *method,
                        const hooke_options *options, const char *scene_text);

/* Writes a group `options` with an attribute for each option that has a value. Negative on failure. */
herr_t hk_h5md_write_options(hid_t where, const hooke_options *options);

/* Writes /connectivity/springs and /hooke/rest_length; the particles group must exist. */
herr_t hk_h5md_connect(hid_t file, const hooke_system *system, const char *group);

/* Room for what is known later of a single run. Negative on failure. */
herr_t hk_h5md_make_room(hid_t file);

/* Copies everything but the frames to an empty file, and makes their arrays there (hk_frame_arrays_make()).
 */
herr_t hk_h5md_copy(hid_t from, hid_t to, struct hk_frame_file *frames);

/* Offsets of what is written as bytes; -1 for what an older file does not have. */
void hk_h5md_find(hid_t file, int64_t at[HOOKE_PART_COUNT]);

/* 1 if the run came to an end: the file has just the frames that were written. */
int32_t hk_h5md_is_over(hid_t file);

/* Writes the word of an outcome while the file is open in HDF5. */
herr_t hk_h5md_set_status(hid_t file, int32_t outcome);

/* The check value of everything but frames and outcome (outcome.h): as it should be, where `scene` may be
 * NULL, and that of a run as it is stored; `there` is 0 in older files, which have none. Statuses of HDF5,
 * HOOKE_BAD_VALUE and HOOKE_NO_MEMORY as of reading arrays. */
int32_t hk_file_check_description(struct hk_h5_guard *guard, const char *scene, uint32_t *value);
int32_t hk_file_check_read(struct hk_h5_guard *guard, uint32_t *value, int32_t *there);
