/* Objects of every type, shape and layout that HDF5 can make, in the places where hooke looks for its own. */
#include "container_edit_h5.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>

enum { MOST_FILLED = 4096, TYPES = 20, LAYOUTS = 11 };

/* ---- types ---- */

static hid_t half_float(void) {
  hid_t type = H5Tcopy(H5T_IEEE_F32LE);
  H5Tset_fields(type, 15, 10, 5, 0, 10);
  H5Tset_size(type, 2);
  H5Tset_ebias(type, 15);
  return type;
}

static hid_t narrow_integer(void) {
  hid_t type = H5Tcopy(H5T_STD_I32LE);
  H5Tset_precision(type, 12);
  H5Tset_offset(type, 5);
  return type;
}

static hid_t compound(void) {
  hid_t type = H5Tcreate(H5T_COMPOUND, 16);
  H5Tinsert(type, "x", 0, H5T_IEEE_F64LE);
  H5Tinsert(type, "y", 8, H5T_IEEE_F64LE);
  return type;
}

static hid_t enumeration(void) {
  const int32_t one = 1;
  hid_t type = H5Tenum_create(H5T_STD_I32LE);
  H5Tenum_insert(type, "one", &one);
  return type;
}

static hid_t text(size_t size) {
  hid_t type = H5Tcopy(H5T_C_S1);
  H5Tset_size(type, size);
  return type;
}

static hid_t new_type(uint32_t number) {
  const hsize_t three = 3;
  switch (number % TYPES) {
  case 0:
    return H5Tcopy(H5T_IEEE_F32LE);
  case 1:
    return H5Tcopy(H5T_IEEE_F64BE);
  case 2:
    return H5Tcopy(H5T_STD_I32LE);
  case 3:
    return H5Tcopy(H5T_STD_I64LE);
  case 4:
    return H5Tcopy(H5T_STD_U8LE);
  case 5:
    return H5Tcopy(H5T_STD_U64BE);
  case 6:
    return half_float();
  case 7:
    return narrow_integer();
  case 8:
    return text(8);
  case 9:
    return text(H5T_VARIABLE);
  case 10:
    return compound();
  case 11:
    return H5Tarray_create2(H5T_IEEE_F64LE, 1, &three);
  case 12:
    return enumeration();
  case 13:
    return H5Tcopy(H5T_STD_REF_OBJ);
  case 14:
    return H5Tcreate(H5T_OPAQUE, 8);
  case 15:
    return H5Tvlen_create(H5T_IEEE_F64LE);
  case 16:
    return H5Tcopy(H5T_STD_B64LE);
  default:
    return H5Tcopy(H5T_IEEE_F64LE);
  }
}

/* ---- shapes ---- */

static hsize_t extent(uint32_t number) {
  static const hsize_t extents[] = {4, 3, 1, 0, 2, 5, 12, 64, 999, 70000, 1u << 31, (hsize_t)1 << 40};
  return extents[number % (sizeof extents / sizeof extents[0])];
}

/* Half of them have the sizes that hooke expects. */
static int shape(uint64_t value, hsize_t size[4]) {
  static const struct {
    int rank;
    hsize_t size[4];
  } usual[] = {{3, {4, 4, 3}}, {1, {4}}, {2, {3, 2}}, {2, {4, 3}},
               {2, {4, 1}},    {1, {3}}, {0, {0}},    {2, {1, 4}}};
  const uint32_t bits = (uint32_t)(value >> 8);
  if (value & 1) {
    memcpy(size, usual[bits % 8].size, sizeof usual[0].size);
    return usual[bits % 8].rank;
  }
  for (int k = 0; k < 4; k++)
    size[k] = extent((uint32_t)(value >> (16 + 8 * k)) & 255);
  return (int)(bits % 5);
}

static hid_t new_space(int rank, const hsize_t *size, const hsize_t *most) {
  return rank > 0 ? H5Screate_simple(rank, size, most) : H5Screate(rank == 0 ? H5S_SCALAR : H5S_NULL);
}

/* ---- layouts ---- */

struct plan {
  int rank, chunked, unwritten, part;
  hsize_t size[4], chunk[4], most[4];
};

static void set_filter(hid_t list, uint32_t layout) {
  if (layout == 4) H5Pset_deflate(list, 6);
  if (layout == 9) H5Pset_shuffle(list), H5Pset_fletcher32(list);
  if (layout == 10) H5Pset_scaleoffset(list, H5Z_SO_INT, 0);
}

/* `layout`: contiguous, contiguous without room, compact, chunked, deflated, chunked with one chunk,
 * external, virtual, chunked without limit, checked by Fletcher's sum, by scale and offset. */
static void set_layout(const struct container *container, uint32_t layout, const char *name, hid_t list,
                       struct plan *plan) {
  char path[96];
  hsize_t numbers = 1;
  for (int k = 0; k < plan->rank; k++) {
    plan->chunk[k] = plan->size[k] < 1 ? 1 : plan->size[k] > 64 ? 64 : plan->size[k];
    plan->most[k] = layout == 8 ? H5S_UNLIMITED : plan->size[k];
    numbers *= plan->size[k] < 1000000 ? plan->size[k] : 1000000;
  }
  H5Pset_obj_track_times(list, 0);
  plan->unwritten = numbers > MOST_FILLED || layout == 1 || layout == 6 || layout == 7;
  plan->part = layout == 5;
  plan->chunked = plan->rank > 0 && (layout >= 3 && layout != 6 && layout != 7);
  if (plan->part && plan->rank > 0) plan->chunk[0] = 1;
  if (plan->chunked) H5Pset_chunk(list, plan->rank, plan->chunk), set_filter(list, layout);
  if (layout == 2) H5Pset_layout(list, H5D_COMPACT);
  if (layout == 0 && !plan->unwritten) H5Pset_alloc_time(list, H5D_ALLOC_TIME_EARLY);
  if (layout == 6) {
    snprintf(path, sizeof path, "%s/raw.bin", container->folder);
    H5Pset_external(list, path, 0, H5F_UNLIMITED);
  }
  if (layout == 7 && plan->rank > 0) {
    snprintf(path, sizeof path, "%s/other.h5", container->folder);
    hid_t space = new_space(plan->rank, plan->size, NULL);
    H5Pset_virtual(list, space, plan->chunk[0] & 1 ? "." : path, plan->chunk[0] & 1 ? name : "/numbers",
                   space);
    H5Sclose(space);
  }
}

/* ---- contents ---- */

/* Small ascending numbers, with one exception. */
static void fill(double *number, hsize_t count, const struct edit *edit) {
  const double odd = edit_double(edit->value >> 40);
  for (hsize_t k = 0; k < count; k++)
    number[k] = edit->how & 64 ? (double)(k % 3) : 0.02 * (double)k;
  if ((edit->how & 128) && count > 0) number[(edit->value >> 48) % count] = odd;
}

static void write_some(hid_t data, const struct plan *plan, const struct edit *edit) {
  hid_t space = H5Dget_space(data), type = H5Dget_type(data), here;
  const H5T_class_t class = H5Tget_class(type);
  const hsize_t begin[4] = {0};
  if (plan->part && plan->rank > 0)
    H5Sselect_hyperslab(space, H5S_SELECT_SET, begin, NULL, plan->chunk, NULL);
  const hssize_t count = H5Sget_select_npoints(space);
  if (count > 0 && count <= MOST_FILLED && (class == H5T_FLOAT || class == H5T_INTEGER)) {
    double *number = malloc((size_t)count * sizeof *number);
    const hsize_t line = (hsize_t)count;
    fill(number, line, edit);
    here = H5Screate_simple(1, &line, NULL);
    H5Dwrite(data, H5T_NATIVE_DOUBLE, here, space, H5P_DEFAULT, number);
    H5Sclose(here);
    free(number);
  } else if (count > 0 && count <= MOST_FILLED && class == H5T_STRING && H5Tis_variable_str(type) == 0) {
    const hsize_t line = (hsize_t)count;
    char *bytes = calloc((size_t)count, H5Tget_size(type));
    memset(bytes, 'x', (size_t)count * H5Tget_size(type));
    here = H5Screate_simple(1, &line, NULL);
    H5Dwrite(data, type, here, space, H5P_DEFAULT, bytes);
    H5Sclose(here);
    free(bytes);
  }
  H5Tclose(type);
  H5Sclose(space);
}

static void put_array(hid_t file, const struct container *container, const char *name, hid_t type,
                      struct plan *plan, const struct edit *edit) {
  hid_t list = H5Pcreate(H5P_DATASET_CREATE);
  set_layout(container, edit->how % LAYOUTS, name, list, plan);
  hid_t space = new_space(plan->rank, plan->size, plan->chunked ? plan->most : NULL);
  hid_t data = H5Dcreate2(file, name, type, space, H5P_DEFAULT, list, H5P_DEFAULT);
  if (data >= 0 && !plan->unwritten) write_some(data, plan, edit);
  if (data >= 0) H5Dclose(data);
  if (space >= 0) H5Sclose(space);
  H5Pclose(list);
}

/* ---- texts ---- */

#define FROM(dataset)  "{\"file\": \"c.h5\", \"dataset\": \"" dataset "\"}"
#define SCENE_OF(rest) ("{\"hooke\": 1, " rest "}")

static const char *const texts[] = {
    "finished",
    "running",
    "",
    "{}",
    SCENE_OF("\"particles\": {\"position\": [[0,0,0],[1,0,0]], \"mass\": 1}"),
    SCENE_OF("\"particles\": {\"position\": " FROM("/particles/all/position/value") ", \"mass\": " FROM(
        "/particles/all/mass") "}, \"springs\": [{\"between\": " FROM("/connectivity/springs") ", "
                                                                                               "\"stiffness\""
                                                                                               ": 3}]"),
    SCENE_OF("\"particles\": {\"position\": " FROM(
        "/particles/all/velocity/value") ", \"mass\": 1, \"pinned\": " FROM("/particles/all/species") "}"),
    SCENE_OF("\"parts\": [{\"kind\": \"rope\", \"from\": [0,0,0], \"to\": [1,0,0], \"segments\": 3, "
             "\"mass\": 1, \"stretch\": {\"stiffness\": 5}}]"),
    "\xff\xfe garbage",
    "[1, 2, 3]",
    SCENE_OF(
        "\"particles\": {\"position\": {\"file\": \"other.h5\", \"dataset\": \"/numbers\"}, \"mass\": 1}"),
};

/* A text of fixed or variable length; single or in an array; in each layout. */
static void put_text(hid_t file, const struct container *container, const char *name,
                     const struct edit *edit) {
  const char *words = texts[edit->what % (sizeof texts / sizeof texts[0])];
  const size_t own = strlen(words), length = edit->how & 16 ? (edit->value >> 48) % 5000 + 1 : own ? own : 1;
  struct plan plan = {.rank = edit->how & 32 ? (int)(edit->value & 1) : 0,
                      .size = {extent((uint32_t)(edit->value >> 8) & 255)}};
  struct edit to = *edit;
  to.how =
      plan.rank == 0 && edit->how % LAYOUTS != 6 ? (uint8_t)(edit->how % LAYOUTS == 2 ? 2 : 0) : edit->how;
  hid_t type = text(edit->how & 128 ? H5T_VARIABLE : length);
  if (edit->how & 64) H5Tset_cset(type, H5T_CSET_UTF8);
  put_array(file, container, name, type, &plan, &to);
  hid_t data = H5Dopen2(file, name, H5P_DEFAULT);
  if (data >= 0 && plan.rank == 0 && edit->how % LAYOUTS != 6) {
    char *bytes = calloc(length + own + 1, 1);
    memcpy(bytes, words, own);
    H5Dwrite(data, type, H5S_ALL, H5S_ALL, H5P_DEFAULT, edit->how & 128 ? (const void *)&words : bytes);
    free(bytes);
  }
  if (data >= 0) H5Dclose(data);
  H5Tclose(type);
}

/* ---- attributes ---- */

static const char *const options[] = {"method",        "step",      "duration",  "every",  "rtol",
                                      "atol",          "threads",   "max_steps", "newton", "linear_solver",
                                      "atol_velocity", "max_order", "run_id",    "version"};
static const char *const words[] = {
    "symplectic-euler", "verlet", "rk4", "nonsense", "", "0.01", "nan", "1e999"};

static void put_attribute(hid_t file, const struct container *container, const struct edit *edit) {
  const char *where = edit->how & 1 ? "/hooke" : "/hooke/options";
  if ((edit->how & 7) == 7) where = container->name[edit->where % container->names];
  const char *name = options[edit->what % (sizeof options / sizeof options[0])];
  hid_t object = H5Oopen(file, where, H5P_DEFAULT);
  if (object < 0) return;
  H5Adelete(object, name);
  hsize_t size[4] = {1, 1, 1, 1};
  const int rank = edit->how & 8 ? shape(edit->value, size) : 0;
  hsize_t count = 1;
  for (int k = 0; k < rank; k++)
    count *= size[k] < 100 ? size[k] : 100;
  const uint32_t kind = (edit->how >> 4) % 4;
  hid_t type = kind == 0   ? H5Tcopy(H5T_IEEE_F64LE)
               : kind == 1 ? text(H5T_VARIABLE)
                           : new_type((uint32_t)(edit->value >> 56));
  if (kind == 1 && (edit->value & 2)) H5Tset_cset(type, H5T_CSET_UTF8);
  hid_t space = new_space((edit->how & 128) ? -1 : rank, size, NULL);
  hid_t attribute =
      kind == 3 || count > 64 ? -1 : H5Acreate2(object, name, type, space, H5P_DEFAULT, H5P_DEFAULT);
  if (attribute >= 0) {
    double number[64];
    const char *word[64];
    for (int k = 0; k < 64; k++) {
      number[k] = edit_double(edit->value >> 32);
      word[k] = words[(edit->value >> 32) % (sizeof words / sizeof words[0])];
    }
    if (H5Tis_variable_str(type) > 0)
      H5Awrite(attribute, type, word);
    else if (H5Tget_class(type) == H5T_FLOAT || H5Tget_class(type) == H5T_INTEGER)
      H5Awrite(attribute, H5T_NATIVE_DOUBLE, number);
    H5Aclose(attribute);
  }
  H5Sclose(space);
  H5Tclose(type);
  H5Oclose(object);
}

/* ---- objects ---- */

static const char *other_name(const struct container *container, uint64_t value) {
  return value % 16 == 0   ? "/"
         : value % 16 == 1 ? "/nowhere"
                           : container->name[(value >> 4) % (uint64_t)container->names];
}

static void put_link(hid_t file, const struct container *container, const char *name,
                     const struct edit *edit) {
  char path[96];
  const char *to = other_name(container, edit->value);
  if (edit->kind == EDIT_HARD) {
    H5Lcreate_hard(file, to, file, name, H5P_DEFAULT, H5P_DEFAULT);
  } else if (edit->kind == EDIT_SOFT) {
    H5Lcreate_soft(to, file, name, H5P_DEFAULT, H5P_DEFAULT);
  } else {
    snprintf(path, sizeof path, "%s/%s", container->folder, edit->how & 1 ? "missing.h5" : "other.h5");
    H5Lcreate_external(path,
                       edit->how & 2   ? "/text"
                       : edit->how & 4 ? "/"
                                       : "/numbers",
                       file, name, H5P_DEFAULT, H5P_DEFAULT);
  }
}

static void put_other(hid_t file, const struct container *container, const char *name,
                      const struct edit *edit) {
  struct plan plan = {0};
  hid_t type, group;
  char longer[256];
  switch (edit->kind) {
  case EDIT_ARRAY:
    type = new_type(edit->what);
    plan.rank = shape(edit->value, plan.size);
    H5Ldelete(file, name, H5P_DEFAULT);
    put_array(file, container, name, type, &plan, edit);
    H5Tclose(type);
    break;
  case EDIT_TEXT:
    H5Ldelete(file, name, H5P_DEFAULT);
    put_text(file, container, name, edit);
    break;
  case EDIT_GROUP:
    H5Ldelete(file, name, H5P_DEFAULT);
    group = H5Gcreate2(file, name, H5P_DEFAULT, H5P_DEFAULT, H5P_DEFAULT);
    if (group >= 0) H5Gclose(group);
    break;
  case EDIT_TYPE:
    H5Ldelete(file, name, H5P_DEFAULT);
    type = new_type(edit->what);
    H5Tcommit2(file, name, type, H5P_DEFAULT, H5P_DEFAULT, H5P_DEFAULT);
    H5Tclose(type);
    break;
  case EDIT_RENAME:
    snprintf(longer, sizeof longer, "%s_", name);
    H5Lmove(file, name, file, longer, H5P_DEFAULT, H5P_DEFAULT);
    break;
  default:
    H5Ldelete(file, name, H5P_DEFAULT);
  }
}

void container_edit_structure(hid_t file, const struct container *container, const struct edit *edit) {
  const char *name = container->name[edit->where % container->names];
  if (edit->kind == EDIT_ATTRIBUTE) {
    put_attribute(file, container, edit);
  } else if (edit->kind == EDIT_SOFT || edit->kind == EDIT_EXTERNAL || edit->kind == EDIT_HARD) {
    H5Ldelete(file, name, H5P_DEFAULT);
    put_link(file, container, name, edit);
  } else {
    put_other(file, container, name, edit);
  }
}
