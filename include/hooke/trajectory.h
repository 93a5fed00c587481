/* hooke/trajectory.h - what a run writes: trajectories (H5MD), which are read and viewed, too, and probes.
 *
 * They need a build with HDF5, except for probes as CSV; without it these functions return HOOKE_NOT_BUILT.
 */
#ifndef HOOKE_TRAJECTORY_H
#define HOOKE_TRAJECTORY_H

#include "measurement.h"

#ifdef __cplusplus
extern "C" {
#endif

/* For a program that owns its whole process (the command line): keeps HDF5 from running code at exit, which
 * crashes in some versions after a failed write. Call it before anything else. A library inside a larger
 * program must not call it. */
HOOKE_API int32_t hooke_io_own_process(void);

typedef struct hooke_trajectory hooke_trajectory;

/* Creates an H5MD 1.1 file for all frames that `integrator` is going to report on `system`, sized in advance
 * so that every frame written survives even if the process is killed. An existing file is replaced only when
 * the new one is ready to take frames. `scene_text` may be NULL; if the scene names files, the numbers of
 * `system` are stored instead of these names, so that the file is self-contained (unless the system has
 * callbacks, which no scene can hold). Until the trajectory is closed no other run can open the file for
 * writing, in this process or another. A process that is forked from this one can only close the trajectory,
 * which leaves the file alone; other calls return HOOKE_BAD_CALL. HOOKE_IO_FAILED, also if another run is
 * writing `path`; HOOKE_NOT_BUILT, HOOKE_NO_MEMORY. */
HOOKE_API int32_t hooke_trajectory_create(const char *path, const hooke_system *system,
                                          const hooke_integrator *integrator, const char *scene_text,
                                          hooke_trajectory **trajectory);

/* Writes the next frame. After a failed write the file is marked bad and takes no more: HOOKE_IO_FAILED. The
 * file stays as it is with HOOKE_BAD_VALUE for a state that does not fit and HOOKE_BAD_CALL for a frame too
 * many. */
HOOKE_API int32_t hooke_trajectory_write(hooke_trajectory *trajectory, int64_t step,
                                         const hooke_state *state);

/* Turns on asynchronous writing: from here on hooke_trajectory_write() copies a large frame, of 1366
 * particles or more, and returns, and a thread of the trajectory writes it. The thread needs the memory of
 * one state and calls nothing but the operating system, no HDF5. The next frame waits until the previous one
 * is written. The next call returns a failed write. A process that is killed may lose the one queued frame.
 * The system has to outlive the trajectory. May be called before the first frame or later. HOOKE_NO_MEMORY,
 * HOOKE_IO_FAILED. */
HOOKE_API int32_t hooke_trajectory_write_behind(hooke_trajectory *trajectory);

/* Marks the frames from the next one on as after divergence: those that the option `past_divergence` adds,
 * which come while the integrator's "diverged_at" is not NaN. A second call does nothing. HOOKE_IO_FAILED. */
HOOKE_API int32_t hooke_trajectory_mark_diverged(hooke_trajectory *trajectory);

/* Waits for the frame on its way and brings all data to the disk: what is there then outlasts a power
 * failure, too. A failure marks the file bad. HOOKE_IO_FAILED. */
HOOKE_API int32_t hooke_trajectory_sync(hooke_trajectory *trajectory);

/* "run": identifier of the run that the file is of, 32 hexadecimal digits, unique to the run and stored in
 * the file; "origin": says in words from where a run continued, and why not from a checkpoint, "" for a
 * trajectory that was not opened by hooke_trajectory_resume(). NULL for another word. Valid as long as the
 * trajectory. */
HOOKE_API const char *hooke_trajectory_text(const hooke_trajectory *trajectory, const char *what);

/* Waits for the last frame, writes the outcome (a status of hooke_integrator_run), truncates the file to its
 * frames, and releases it on every path. HOOKE_IO_FAILED. NULL is allowed. */
HOOKE_API int32_t hooke_trajectory_close(hooke_trajectory *trajectory, int32_t outcome);

/* ---- probes ---- */

typedef struct hooke_probes hooke_probes;

/* Writes watched quantities (hooke/measurement.h) over the runs of `integrator`, which has to live until they
 * are closed, into the file `path` while these go: .csv, a line of names (time [s], and each quantity as it
 * was given) and a line a time, whose numbers read back to the same bits; .h5 or .hdf5, the table /probes
 * with these columns and the attribute "units". `options` are those of "probes": the quantities ("probe"),
 * and the time between two lines ("probe_every"), to which all is said in hooke/integrator.h that is said of
 * frames. A number that is not finite is left out, NaN in a table. An older file is replaced when the new one
 * is ready to take lines; a run that ends early keeps its lines. A write that fails stops the run,
 * HOOKE_STOPPED, and closing tells why. HOOKE_BAD_VALUE for the options, for another ending, without a
 * duration, and for the scene's own files; HOOKE_UNSUITED for a first- or second-order problem;
 * HOOKE_IO_FAILED, HOOKE_NO_MEMORY, HOOKE_NOT_BUILT. */
HOOKE_API int32_t hooke_probes_create(hooke_integrator *integrator, const hooke_options *options,
                                      const char *path, hooke_probes **probes);
/* "lines" that were written, without that of names, and the "time" of the last one [s], NaN before the first;
 * NaN for another word. */
HOOKE_API double hooke_probes_number(const hooke_probes *probes, const char *what);
/* Brings the lines to the disk, and releases the probes on every path. HOOKE_IO_FAILED, HOOKE_NO_MEMORY. NULL
 * is allowed. */
HOOKE_API int32_t hooke_probes_close(hooke_probes *probes);

/* ---- reading trajectories ---- */

typedef struct hooke_record hooke_record;

/* Opens a trajectory file, finished or not. HOOKE_IO_FAILED, HOOKE_BAD_VALUE if it was not written by this
 * library, HOOKE_NOT_BUILT, HOOKE_NO_MEMORY. */
HOOKE_API int32_t hooke_record_open(const char *path, hooke_record **record);
HOOKE_API void hooke_record_close(hooke_record *record);

/* "scene": the text of the scene, "" if there was none; "status": "running", "finished", "stopped",
 * "diverged", "step-limit", "solver-failed" or "failed"; "run": the identifier of the run, see
 * hooke_trajectory_text(), "" if an earlier version wrote it; "error_by" and "error_reason": "by" and
 * "reason" of an estimate, "" where nothing is known of the error; "version", "sundials", "cholmod",
 * "blas", "instructions", "machine": the build that made the file, see hooke_build_fact(); "callbacks" of the
 * run, which no file holds: "none", "force", "force with derivative", "drive", "force and drive", ...; ""
 * where the file does not say. NULL for another word. */
HOOKE_API const char *hooke_record_text(const hooke_record *record, const char *what);
/* Options of the run, with all defaults filled in; valid as long as the record. */
HOOKE_API const hooke_options *hooke_record_options(const hooke_record *record);

/* "frames" that are there; "good_frames": those of them before the run diverged, the first so many, all if
 * none were added by the option `past_divergence`. -1 for another word. */
HOOKE_API int64_t hooke_record_count(const hooke_record *record, const char *what);
/* Reads a frame into a state of the scene's system, negative ones from the end: -1 is the last.
 * HOOKE_BAD_VALUE if there is none, if it is damaged, or if the state does not fit; HOOKE_IO_FAILED,
 * HOOKE_NO_MEMORY. The state is then as it was. */
HOOKE_API int32_t hooke_record_read(const hooke_record *record, int64_t frame, hooke_state *state);

/* Compares the numbers of a frame with its check value: HOOKE_BAD_VALUE for a damaged frame, whose numbers
 * are not those that were written. Frames without a check value, in files of older versions, pass.
 * hooke_record_read() makes the same check. Arrays that are read as a whole are not checked, nor are programs
 * that read the file by themselves. */
HOOKE_API int32_t hooke_record_check(const hooke_record *record, int64_t frame);

/* Read a whole array of the file: hooke_record_size() returns its rows and columns, hooke_record_numbers()
 * copies rows x columns numbers. One row a frame: "time" [s], "step", "kinetic_energy" and the other
 * observables of docs/trajectory.md, of all frames that the file was made for (the first
 * "frames" of them were written); one a spring: "springs", its two ends; one a particle:
 * "mass" [kg], "species" (0 free, 1 pinned, 2 driven). "error": the error of the run, NaN where it is not
 * known, in the order of docs/trajectory.md. HOOKE_BAD_VALUE for another word, or if the file has no such
 * array; HOOKE_IO_FAILED, HOOKE_NO_MEMORY. */
HOOKE_API int32_t hooke_record_size(hooke_record *record, const char *what, int64_t *rows, int64_t *columns);
HOOKE_API int32_t hooke_record_numbers(hooke_record *record, const char *what, double *values);

/* Offset of "position" or "velocity" in the file [bytes], for a program that maps the file into memory:
 * frames of n rows of x y z, doubles of this machine, one after the other. -1 where they are not stored so,
 * or for another word; hooke_record_read() reads them in any case. */
HOOKE_API int64_t hooke_record_place(const hooke_record *record, const char *what);

/* ---- viewing trajectories ---- */

/* Creates a measurement of kind "view": a page, in HTML and readable offline, that plays a trajectory, with
 * surfaces and springs, strain as colour, what is pinned and what is driven, energies over time.
 * hooke_measurement_write() writes it, whatever the ending of its path; no hooke_measurement_run() is needed.
 * Its heading is the label "title", or else the title of the scene, or the name of the file. Its numbers are
 * the table "view". Springs: every k-th, if there are more than the options allow. Frames: as many as they
 * allow, evenly, and always the last one; damaged ones are skipped. The record has to live as long as the
 * view. `options` may be NULL. HOOKE_BAD_VALUE for a file of several runs, one without frames, or a size
 * that is too small; HOOKE_NOT_BUILT in a build without three.js and Chart.js, or where files of
 * share/hooke are missing; HOOKE_IO_FAILED, HOOKE_NO_MEMORY. */
HOOKE_API int32_t hooke_view_create(const hooke_record *record, const hooke_options *options,
                                    hooke_measurement **view);

/* Shows `other` beside `view` on its page, where they play at the same time and are seen from the same angle;
 * both have to live until it is written. HOOKE_BAD_VALUE for measurements of another kind, or more than eight
 * in all. */
HOOKE_API int32_t hooke_view_add(hooke_measurement *view, const hooke_measurement *other);

/* Writes the companion by which ParaView reads a trajectory: XDMF 2, a few lines of XML for each frame, which
 * refer to the numbers in the HDF5 file. `path` NULL: beside the trajectory, with .xdmf in place of its .h5;
 * a file of this name that is no XDMF is then not replaced. Springs are lines, with rest_length; particles
 * have velocity, mass and species. HOOKE_BAD_VALUE if there are no frames, and for a trajectory name that
 * ParaView's reader does not accept: it requires ASCII without colons; HOOKE_IO_FAILED, HOOKE_NO_MEMORY,
 * HOOKE_NOT_BUILT. */
HOOKE_API int32_t hooke_record_write_xdmf(const hooke_record *record, const char *path);

#ifdef __cplusplus
}
#endif
#endif
