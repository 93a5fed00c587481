/* Metadata and springs of an H5MD file. Layout (H5MD 1.1):
 *
 *   /h5md                    version [1, 1]; author, creator
 *   /hooke                   attributes version, abi, sundials, cholmod, instructions, machine, units,
 *                            method, `callbacks` (model/callbacks.h), of a single run `run`, which no other
 *                            run has; `scene`: the text of the scene; `options`: an attribute for each
 *                            option of the run; `status`: "running" until the file is closed
 *   /hooke/rest_length       [springs]
 *   /hooke/file_check        [1] check value of everything but the frames (file_check_h5.h)
 *   /hooke/beyond            of a single run: the first frame after it diverged; -1: there is none
 *   /hooke/error             of a single run: HOOKE_ERROR_COUNT numbers, NaN until they are known; texts
 *                            `error_by`, `error_reason`
 *   /particles/<group>       frames (trajectory_writer_h5.h)
 *   /connectivity/springs    [springs][2] particle numbers
 *   /observables             frames (trajectory_writer_h5.h)
 *
 * The status is raw data of fixed length, like everything written after the first frame: a killed process
 * could leave metadata that change in place torn. */
#ifndef HOOKE_IO_TRAJECTORY_H5MD_H5_H
#define HOOKE_IO_TRAJECTORY_H5MD_H5_H

#include "hooke/integrator.h"
#include "io/hdf5/copy_h5.h"

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

/* The attribute `run` of /hooke: 24 random hexadecimal digits, 8 of their check value (file_check_h5.h) and a
 * NUL. */
enum { HOOKE_RUN_RANDOM = 24, HOOKE_RUN_SIZE = 33 };
int32_t hk_h5md_new_run(uint32_t description, char run[HOOKE_RUN_SIZE]);
herr_t hk_h5md_write_run(hid_t file, const char *run);

/* Recreates everything but particles, observables and check values in another file; hk_h5md_refer() has to
 * follow once the particles group exists. */
herr_t hk_h5md_copy(hid_t from, hid_t to, struct hk_h5_copy *copy);
herr_t hk_h5md_refer(hid_t file, const char *group);

/* Offsets of what is written as bytes, once HDF5 has closed the file; -1 for what an older one does not
 * have. */
struct hk_h5md_places {
  int64_t status, beyond, check, error, error_by, error_reason;
};
void hk_h5md_find(hid_t file, struct hk_h5md_places *at);

/* Writes bytes to one of them, nothing if it is not there: 0 or an errno. */
int hk_h5md_write(int descriptor, int64_t at, int64_t bytes, const void *data);

/* The word for a status of hooke_integrator_run() or HOOKE_H5MD_RUNNING; and writing it: 0 or an errno. The
 * bytes are fewer than a page, and aligned to a multiple of them: never torn. */
enum { HOOKE_H5MD_RUNNING = 1000, HOOKE_H5MD_STATUS = 16 };
const char *hk_h5md_word(int32_t outcome);
int hk_h5md_write_status(int descriptor, int64_t at, int32_t outcome);

/* 1 if the run came to an end, by its status (NULL: unknown) or by its file: that has just the frames that
 * were written. */
int32_t hk_h5md_is_end(const char *status);
int32_t hk_h5md_is_over(hid_t file);

/* The same while the file is open in HDF5. */
herr_t hk_h5md_set_status(hid_t file, int32_t outcome);

#endif
