/* Contents of a page that plays a trajectory: springs, particles and frames, and the range of strains.
 *
 *   view.c           selection
 *   view_frames.c    a frame as bytes, and as text
 *   view_page.c      the page, and several as one
 *   view_bodies.c    what its scene tells it
 *   view_watched.c   quantities that are asked for */
#pragma once

#include "hooke/scene.h"
#include "hooke/trajectory.h"
#include "io/file/text.h"
#include "measure/measurement.h"
#include "measure/quantity/watched.h"

enum { HOOKE_VIEW_ENERGIES = 3, HOOKE_VIEW_MOST_BESIDE = 7 };
extern const char *const hk_view_energy[HOOKE_VIEW_ENERGIES]; /* "kinetic", ... */

/* Mark of a particle. */
enum { HOOKE_VIEW_FREE, HOOKE_VIEW_PINNED, HOOKE_VIEW_DRIVEN, HOOKE_VIEW_LOOSE };

extern const struct hk_measurement_kind hk_view_kind;

/* Coordinates that map to 0 and 65535, for the three axes. */
struct hk_view_box {
  double low[3], high[3];
};

/* The object of a measurement of kind "view". */
struct hk_view {
  const hooke_record *record;
  const hooke_options *options; /* of the measurement */
  int64_t particles_there, springs_there, loose_there, frames_there;
  int64_t good_frames; /* of those there, before the run diverged */
  double *rest_length; /* [springs of the file]; of the first frame if the file has none */
  int32_t by_first_frame;
  int64_t spring_stride, loose_stride, frame_stride;
  int64_t springs, particles, frames;  /* number shown */
  int64_t *end;                        /* 2 springs: indices into `particle` */
  int64_t *particle;                   /* of each, its number */
  uint8_t *mark;                       /* of each, HOOKE_VIEW_... */
  int64_t *frame;                      /* of each, its number: the last one is always among them */
  struct hk_view_box *box;             /* of each, around its particles */
  int64_t damaged;                     /* frames that were to be shown and are not whole */
  double *energy[HOOKE_VIEW_ENERGIES]; /* [frames there] */
  double strain;                       /* the largest that has a colour of its own */
  double strain_low, strain_high;      /* that were met */
  struct hk_watched_list watched;      /* of the system of `scene`; none */
  struct hk_watched_series course;     /* their values, [frames] */
  hooke_scene *scene;                  /* NULL without them */
  double bytes;                        /* of the page, once it is written; NaN */
  const hooke_measurement *beside[HOOKE_VIEW_MOST_BESIDE];
  int32_t beside_count;
};

/* A column of numbers, or `columns` of them, from the file, with at least so many rows, or all that there are
 * if that is negative, and then set; the caller frees it. */
int32_t hk_view_read(const struct hk_view *view, const char *dataset, int64_t frame, int64_t *rows,
                     int64_t columns, double **values);

/* Reads the option "watch" by the scene of the file, and finds its quantities at the frames shown.
 * HOOKE_BAD_VALUE for another quantity or without a scene. */
int32_t hk_view_watch(struct hk_view *view);
int32_t hk_view_find_watched(struct hk_view *view);
/* Adds "watched": of each its name, unit and values. */
void hk_view_add_watched(struct hk_text *data, const struct hk_view *view);

/* ---- frames as bytes ---- */

int64_t hk_view_frame_bytes(const struct hk_view *view);

uint32_t hk_view_float(double value); /* its bits as a float */

/* Numbers of the springs shown, picked from those of all, as floats in base64. */
void hk_view_add_floats(struct hk_text *data, const char *key, const struct hk_view *view, const double *all);

/* Of the frames shown, that of index `at`: coordinates of the particles as 16-bit little-endian numbers, x y
 * z in turn, then the elongation of each spring [m] as the upper half of a float. */
int32_t hk_view_pack(struct hk_view *view, int64_t at, uint8_t *bytes);

/* Finds `box`, `strain`, strain_low and strain_high, and leaves damaged frames out. HOOKE_BAD_VALUE if none
 * is whole. */
int32_t hk_view_find_strain(struct hk_view *view);

/* Bytes as text (RFC 4648), and its length. */
void hk_base64_add(struct hk_text *text, const uint8_t *bytes, int64_t count);
int64_t hk_base64_length(int64_t bytes);

/* ---- the page ---- */

/* Adds "bodies", what of a scene has a surface or is a line of particles: of each part kind, first particle,
 * count, and "size" (particles along each axis) of a grid or "triangle" (corners, from the first particle on)
 * of a mesh. Failures go to the text's status. */
void hk_view_add_bodies(struct hk_text *data, const hooke_system *system);
/* Adds "obstacles": of each shape, direction (its normal or axis), radius, and "point", one a frame shown if
 * it moves. */
void hk_view_add_obstacles(struct hk_text *data, const struct hk_view *view, const hooke_system *system);
/* Adds "groups" of springs: name and count of each, and whether it only pulls; and "stiffness": that of the
 * springs shown [N/m]. */
void hk_view_add_springs(struct hk_text *data, const struct hk_view *view, const hooke_system *system);

/* Writes it, with the label "title" as its heading, or that of all beside one another. */
int32_t hk_view_write(const hooke_measurement *measurement, const char *path);
