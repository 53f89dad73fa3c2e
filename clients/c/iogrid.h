// Reads the stream of an iogrid target, interface versions 3 and 4: C99 or C++, no allocation.
// Numbers like 3.9 are sections of docs/spec.md. Places are metres in the car's frame,
// x forward and y to the left. docs/clients.md has examples; link with -lm.
//
// The messages of a frame may come in any order. A frame ends when it is complete, or with the
// first message of a newer one; what was lost of it is unknown then, and never older than it. Bytes
// that do not follow the specification are dropped and counted, whatever they are.
#ifndef IOGRID_H
#define IOGRID_H

#include <math.h>
#include <stddef.h>
#include <stdint.h>
#include <string.h>

#include "iogrid_grid.h"
#include "iogrid_objects.h"

#define IOGRID_SIDE 1024  // cells of a grid along x and y
#define IOGRID_CELL_M 0.1

enum iogrid_class {  // 3.9
  IOGRID_UNKNOWN,
  IOGRID_DRIVABLE_FREE,
  IOGRID_NON_DRIVABLE_FREE,
  IOGRID_FREE,
  IOGRID_MOVING,
  IOGRID_STOPPED,
  IOGRID_STANDING,  // stopped or unmapped
  IOGRID_INFRASTRUCTURE,
  IOGRID_OCCUPIED
};

enum iogrid_result {
  IOGRID_NONE,
  IOGRID_FRAME,       // the frame is in the receiver, until the next call
  IOGRID_FRAME_AGAIN  // likewise, as far as it has come; and the same datagram is to be given again
};

typedef struct {  // some 4 MiB; iogrid_init() first
  uint32_t number, vehicle, run, points_used;
  uint64_t closed_us;         // by the target's clock
  uint8_t complete, partial;  // bit i: sensor i has delivered its scan, or a part of it
  uint8_t knows_unwatched;    // of an older target: false
  uint64_t unwatched;         // bit i: no sensor watches sector i of 64 around the car now (3.5)
  uint8_t has_indexes, has_classes, has_objects, is_whole;
  iogrid_grid indexes, classes;
  iogrid_object_list objects;    // iogrid_objects() reads them
  uint16_t causes;               // 3.9
  uint8_t has_pose;              // else it is not known where the car is, and no class has a place
  double x_m, y_m, heading_rad;  // of the car in the local frame
  uint64_t end_us;               // of the pose, by the poses' clock
  uint8_t has_velocity;          // of the car since the frame before
  double vx_m_s, vy_m_s;         // in the local frame
  uint32_t used, dropped[IOGRID_DROPS];
  char refusal[256];  // why the target has refused its car and sends no grid (3.11), or empty
  // The receiver's own.
  uint8_t is_open, has_run, has_next, had_pose;
  uint32_t number_before;
  int32_t x_mm_before, y_mm_before;
  uint64_t end_us_before;
  uint32_t next, over[16], overs, candidate, candidates, candidate_sequences[2];
  uint32_t crc_p4[256], crc_32[256];
} iogrid_receiver;

static inline void iogrid_init(iogrid_receiver* r) {
  memset(r, 0, sizeof *r);
  for (uint32_t i = 0; i < 256; ++i) {
    r->crc_p4[i] = r->crc_32[i] = i;
    for (int bit = 0; bit < 8; ++bit) {
      r->crc_p4[i] = r->crc_p4[i] >> 1 ^ (r->crc_p4[i] & 1 ? 0xC8DF352FU : 0);
      r->crc_32[i] = r->crc_32[i] >> 1 ^ (r->crc_32[i] & 1 ? 0xEDB88320U : 0);
    }
  }
}

// The car's velocity since the frame before; not over a jump, since the local frame may be another.
static inline void iogrid_follow_car(iogrid_receiver* r, int32_t x_mm, int32_t y_mm) {
  const uint64_t passed = r->end_us - r->end_us_before;  // us
  r->has_velocity = r->has_pose && r->had_pose && r->number == r->number_before + 1 && passed > 0 &&
                    passed <= 500000 && (r->causes & 0x5A) == 0;
  r->vx_m_s = r->has_velocity ? ((double)x_mm - r->x_mm_before) * 1000 / (double)passed : 0;
  r->vy_m_s = r->has_velocity ? ((double)y_mm - r->y_mm_before) * 1000 / (double)passed : 0;
  r->had_pose = r->has_pose;
  r->number_before = r->number;
  r->x_mm_before = x_mm;
  r->y_mm_before = y_mm;
  r->end_us_before = r->end_us;
}

// Hands over what has come of the frame. Also for who has heard nothing for half a second: then
// nothing is of now. False if there is none.
static inline int iogrid_close(iogrid_receiver* r) {
  if (!r->is_open) return 0;
  r->is_open = 0;
  r->next = r->number + 1;
  r->is_whole = r->indexes.has_end;
  if (r->has_indexes) iogrid_close_grid(&r->indexes, r->crc_32, r->dropped);
  if (r->has_classes) iogrid_close_grid(&r->classes, r->crc_32, r->dropped);
  r->is_whole = r->is_whole && (!r->has_indexes || r->indexes.is_whole) &&
                (!r->has_classes || r->classes.is_whole) &&
                (!r->has_objects || iogrid_are_objects_complete(&r->objects));
  const uint8_t* w = r->classes.window;
  r->causes = (uint16_t)iogrid_be16(w + 2);
  r->x_m = (int32_t)iogrid_be32(w + 12) * 1e-3;
  r->y_m = (int32_t)iogrid_be32(w + 16) * 1e-3;
  r->heading_rad = iogrid_be32(w + 20) * 1.4629180792671596e-9;  // 2 pi / 2^32
  r->end_us = iogrid_be64(w + 40);
  static const uint8_t unknown[16] = {0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 255, 255, 255, 255};
  r->has_pose = r->classes.has_window && memcmp(w + 12, unknown, 16) != 0;
  iogrid_follow_car(r, (int32_t)iogrid_be32(w + 12), (int32_t)iogrid_be32(w + 16));
  return 1;
}

static inline void iogrid_open(iogrid_receiver* r, const uint8_t* content) {
  r->is_open = r->has_next = 1;
  r->next = r->number = iogrid_be32(content + 8);
  r->has_classes = (content[1] & 0x04) != 0;
  r->has_indexes = (content[1] & 0x08) == 0;
  r->has_objects = (content[1] & 0x10) != 0;
  iogrid_begin_grid(&r->indexes, 0);
  iogrid_begin_grid(&r->classes, 1);
  memset(&r->objects, 0, sizeof r->objects);
  r->knows_unwatched = 0;
}

static inline int iogrid_take_body(iogrid_receiver* r, const uint8_t* content, const uint8_t* body,
                                   size_t bytes) {
  if (content[0] == 5) return r->has_objects && iogrid_take_objects(&r->objects, body, bytes);
  static const uint8_t indexes[18] = {5, 0,    4,    0,    4, 0,    0,    100,  0,
                                      0, 0xFF, 0xFF, 0x38, 0, 0xFF, 0xFF, 0x38, 0};
  static const uint8_t classes[18] = {5, 2, 4, 0, 4, 0, 0, 100, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0};
  const int has_head = content[0] == 1 && bytes >= 24;
  const int is_of_classes = content[0] == 3 || (has_head && memcmp(body + 6, classes, 18) == 0);
  if (content[0] == 1 && !(has_head && (is_of_classes || memcmp(body + 6, indexes, 18) == 0)))
    return 0;
  iogrid_grid* grid = is_of_classes ? &r->classes : &r->indexes;
  size_t at = content[0] == 1 ? 24 : 0;
  if (is_of_classes) {
    const size_t window = at;
    at = r->has_classes ? iogrid_window(grid, body, bytes, at) : 0;
    if (at == 0 ||
        (content[0] == 1 && !iogrid_take_tiles(grid, r->number, r->dropped, body, bytes, at)))
      return 0;
    if (content[0] == 3 && bytes - at < 12) return 0;
    memcpy(grid->window, body + window, 48);
    grid->has_window = 1;
  } else if (content[0] == 1) {
    return r->has_indexes && iogrid_take_tiles(grid, r->number, r->dropped, body, bytes, at);
  }
  if (content[0] != 1) {
    if (bytes - at < 12) return 0;
    grid->sent = iogrid_be32(body + at);
    grid->not_sent = iogrid_be32(body + at + 4);
    grid->name = iogrid_be32(body + at + 8);
    grid->has_end = 1;
    if (content[0] == 2)
      r->knows_unwatched = (uint8_t)iogrid_unwatched(content[24], body, bytes, &r->unwatched);
  }
  return 1;
}

static inline enum iogrid_result iogrid_drop_it(iogrid_receiver* r, enum iogrid_drop cause) {
  ++r->dropped[cause];
  return IOGRID_NONE;
}

// Whether a message's run is the newest (3.2); the third message in a row of another one makes it
// so.
static inline int iogrid_is_of_newest_run(iogrid_receiver* r, uint32_t run, uint32_t sequence) {
  if (!r->has_run || run == r->run) {
    r->has_run = 1;
    r->run = run;
    r->candidates = 0;
    return 1;
  }
  for (uint32_t i = 0; i < r->overs && i < 16; ++i) {
    if (r->over[i] == run) return 0;
  }
  if (run != r->candidate) r->candidates = 0;
  r->candidate = run;
  for (uint32_t i = 0; i < r->candidates; ++i) {
    if (r->candidate_sequences[i] == sequence) return 0;
  }
  if (r->candidates < 2) {
    r->candidate_sequences[r->candidates++] = sequence;
    return 0;
  }
  return 2;
}

// Takes a datagram, whatever its bytes are. `while (iogrid_take(...) == IOGRID_FRAME_AGAIN)` around
// it sees every frame.
static inline enum iogrid_result iogrid_take(iogrid_receiver* r, const void* datagram,
                                             size_t bytes) {
  const uint8_t *m = (const uint8_t*)datagram, *content = m + 28;
  if (bytes < 28 || iogrid_be32(m) != 0x4F478001U || m[12] != 1)
    return iogrid_drop_it(r, IOGRID_NOT_OURS);
  if (m[13] != 3 && m[13] != 4) return iogrid_drop_it(r, IOGRID_OTHER_VERSION);
  if (bytes > 1392 || iogrid_be32(m + 4) != bytes - 8 || iogrid_be16(m + 16) != bytes - 8 ||
      m[14] != 2 || m[15] != 0 || iogrid_be32(m + 20) != 0x494F4701U ||
      iogrid_be32(m + 24) != ~iogrid_crc(r->crc_p4, iogrid_crc(r->crc_p4, 0xFFFFFFFF, m + 8, 16),
                                         content, bytes - 28)) {
    return iogrid_drop_it(r, IOGRID_DAMAGED);
  }
  if (bytes < 76 || iogrid_be16(content + 2) < 48 || iogrid_be16(content + 2) > bytes - 28 ||
      iogrid_be16(m + 18) != iogrid_be16(content + 6)) {
    return iogrid_drop_it(r, IOGRID_MALFORMED);
  }
  const uint8_t* body = content + iogrid_be16(content + 2);
  const size_t body_bytes = bytes - (size_t)(body - m);
  const uint32_t number = iogrid_be32(content + 8), run = iogrid_be32(content + 44);
  const int is_newest = iogrid_is_of_newest_run(r, run, iogrid_be32(content + 4));
  if (is_newest == 0) return iogrid_drop_it(r, IOGRID_OTHER_RUN);
  if (is_newest == 2) {
    if (iogrid_close(r)) return IOGRID_FRAME_AGAIN;
    r->over[r->overs++ % 16] = r->run;
    r->run = run;
    r->candidates = 0;
    r->has_next = 0;
    r->refusal[0] = 0;
    r->had_pose = 0;
    memset(r->indexes.has_own, 0, sizeof r->indexes.has_own);
    memset(r->classes.has_own, 0, sizeof r->classes.has_own);
  }
  if (content[0] == 4 && body_bytes >= 4 && body_bytes - 4 >= body[1]) {
    memcpy(r->refusal, body + 4, body[1]);
    r->refusal[body[1]] = 0;
    return IOGRID_NONE;
  }
  r->used += content[0] == 6; /* receptions: for a PC that repeats the target's run */
  if (content[0] == 6) return IOGRID_NONE;
  if (content[0] < 1 || content[0] > 5 || content[0] == 4)
    return iogrid_drop_it(r, IOGRID_NOT_UNDERSTOOD);
  if (r->has_next && number - r->next >= 0x80000000U) return iogrid_drop_it(r, IOGRID_TOO_LATE);
  if (r->is_open && number != r->number) {
    iogrid_close(r);
    return IOGRID_FRAME_AGAIN;
  }
  if (!r->is_open) iogrid_open(r, content);
  if (((content[1] & 0x04) != 0) != r->has_classes ||
      ((content[1] & 0x08) == 0) != r->has_indexes ||
      ((content[1] & 0x10) != 0) != r->has_objects ||
      !iogrid_take_body(r, content, body, body_bytes)) {
    return iogrid_drop_it(r, IOGRID_MALFORMED);
  }
  ++r->used;
  r->closed_us = iogrid_be64(content + 12);
  r->vehicle = iogrid_be32(content + 20);
  r->complete = content[25];
  r->partial = content[26];
  r->points_used = iogrid_be32(content + 28);
  if (!r->indexes.has_end || (r->has_indexes && r->indexes.spoken_of < IOGRID_TILES) ||
      (r->has_classes && (!r->classes.has_end || r->classes.spoken_of < IOGRID_TILES)) ||
      (r->has_objects && !iogrid_are_objects_complete(&r->objects))) {
    return IOGRID_NONE;
  }
  iogrid_close(r);
  return IOGRID_FRAME;
}

// Whether sensors watch every direction from the one to the other now, counter-clockwise from
// straight ahead: -0.2 to 0.2 is the sector ahead. What is not known is not watched.
static inline int iogrid_is_watched(const iogrid_receiver* r, double from_rad, double to_rad) {
  const double sectors_per_rad = 64 / 6.283185307179586;
  const double first = floor(from_rad * sectors_per_rad), last = floor(to_rad * sectors_per_rad);
  if (!r->knows_unwatched || !(first <= last && last - first <= 64 && fabs(first) < 1e6)) return 0;
  for (int i = (int)first; i <= (int)last; ++i) {
    if (r->unwatched >> ((unsigned)i & 63) & 1) return 0;
  }
  return 1;
}

// The occupancy index of a place: above 0 occupied, below free, 0 unknown or outside.
static inline int iogrid_index_at(const iogrid_receiver* r, double x_m, double y_m) {
  const double x = floor(x_m / IOGRID_CELL_M) + 512, y = floor(y_m / IOGRID_CELL_M) + 512;
  if (!(x >= 0 && x < IOGRID_SIDE && y >= 0 && y < IOGRID_SIDE)) return 0;
  const uint32_t column = (uint32_t)x, row = (uint32_t)y;
  return (int8_t)r->indexes.cells[row / 32 * 32 + column / 32][row % 32 * 32 + column % 32];
}

// The class byte of a cell of the window, row by row from its lowest x and y: class * 8 + sureness.
static inline uint8_t iogrid_cell(const iogrid_receiver* r, uint32_t column, uint32_t row) {
  const uint32_t a = iogrid_be32(r->classes.window + 4), b = iogrid_be32(r->classes.window + 8);
  const uint32_t tile = (b + row / 32) % 32 * 32 + (a + column / 32) % 32;
  return r->classes.cells[tile][row % 32 * 32 + column % 32];
}

// Column and row of a place, with fractions; only if has_pose.
static inline void iogrid_to_cell(const iogrid_receiver* r, double x_m, double y_m, double* column,
                                  double* row) {
  const double c = cos(r->heading_rad), s = sin(r->heading_rad);
  const int32_t a = (int32_t)iogrid_be32(r->classes.window + 4);
  const int32_t b = (int32_t)iogrid_be32(r->classes.window + 8);
  *column = (r->x_m + c * x_m - s * y_m) / IOGRID_CELL_M - 32.0 * a;
  *row = (r->y_m + s * x_m + c * y_m) / IOGRID_CELL_M - 32.0 * b;
}

// The way back, m.
static inline void iogrid_to_car(const iogrid_receiver* r, double column, double row, double* x_m,
                                 double* y_m) {
  const double c = cos(r->heading_rad), s = sin(r->heading_rad);
  const int32_t a = (int32_t)iogrid_be32(r->classes.window + 4);
  const int32_t b = (int32_t)iogrid_be32(r->classes.window + 8);
  const double x = (column + 32.0 * a) * IOGRID_CELL_M - r->x_m;
  const double y = (row + 32.0 * b) * IOGRID_CELL_M - r->y_m;
  *x_m = c * x + s * y;
  *y_m = c * y - s * x;
}

// The place in the car's frame, m, of one in the local frame; only if has_pose.
static inline void iogrid_from_local(const iogrid_receiver* r, int32_t x_mm, int32_t y_mm,
                                     double* x_m, double* y_m) {
  const double c = cos(r->heading_rad), s = sin(r->heading_rad);
  const double x = x_mm * 1e-3 - r->x_m, y = y_mm * 1e-3 - r->y_m;
  *x_m = c * x + s * y;
  *y_m = c * y - s * x;
}

// The first `most` objects of the frame, by id; how many it has. -1: not known, since a part was
// lost, nothing has a place, or the target looks for none.
static inline int iogrid_objects(const iogrid_receiver* r, iogrid_object* to, int most) {
  const iogrid_object_list* list = &r->objects;
  const uint64_t time_us = iogrid_be64(list->says + 4);
  int count = 0;
  if (!iogrid_are_objects_complete(list) || time_us == 0) return -1;
  for (uint32_t part = 0; part < list->parts; ++part) {
    for (uint32_t i = 0; i < list->counts[part]; ++i, ++count) {
      if (count < most) to[count] = iogrid_read_object(list->records[part][i], time_us);
    }
  }
  return count;
}

// How far the middle of an object of the frame is from the car, and how fast that becomes less, the
// car's own motion included. False where one of both velocities is not known.
static inline int iogrid_closing(const iogrid_receiver* r, const iogrid_object* object,
                                 double* distance_m, double* speed_m_s) {
  int32_t x_mm, y_mm;
  uint32_t sigma_mm;
  if (!r->has_velocity || !iogrid_object_at(object, r->end_us, &x_mm, &y_mm, &sigma_mm)) return 0;
  const double x = x_mm * 1e-3 - r->x_m, y = y_mm * 1e-3 - r->y_m;
  const double vx = object->vx_cm_s * 1e-2 - r->vx_m_s, vy = object->vy_cm_s * 1e-2 - r->vy_m_s;
  *distance_m = hypot(x, y);
  *speed_m_s = *distance_m > 0 ? -(x * vx + y * vy) / *distance_m : 0;
  return 1;
}

// The class of a place; IOGRID_UNKNOWN outside of the window, and if there is no pose.
static inline enum iogrid_class iogrid_class_at(const iogrid_receiver* r, double x_m, double y_m) {
  double column, row;
  if (!r->has_pose) return IOGRID_UNKNOWN;
  iogrid_to_cell(r, x_m, y_m, &column, &row);
  if (!(column >= 0 && column < IOGRID_SIDE && row >= 0 && row < IOGRID_SIDE))
    return IOGRID_UNKNOWN;
  return (enum iogrid_class)(iogrid_cell(r, (uint32_t)column, (uint32_t)row) >> 3);
}

// Whether each cell that touches the rectangle is free. What is unknown, lost or outside is not.
static inline int iogrid_is_free(const iogrid_receiver* r, double x_from_m, double x_to_m,
                                 double y_from_m, double y_to_m) {
  const double reach = IOGRID_CELL_M * 0.70710678118654757;  // of a cell from its middle
  const double furthest = IOGRID_SIDE * IOGRID_CELL_M * 2;
  double column, row, x, y;
  if (!r->has_pose || !(x_from_m <= x_to_m && y_from_m <= y_to_m)) return 0;
  if (x_from_m < -furthest || x_to_m > furthest || y_from_m < -furthest || y_to_m > furthest)
    return 0;
  iogrid_to_cell(r, (x_from_m + x_to_m) / 2, (y_from_m + y_to_m) / 2, &column, &row);
  const int half = (int)(hypot(x_to_m - x_from_m, y_to_m - y_from_m) / 2 / IOGRID_CELL_M) + 2;
  for (int i = -half; i <= half; ++i) {
    for (int j = -half; j <= half; ++j) {
      const double cell_column = floor(column) + j, cell_row = floor(row) + i;
      iogrid_to_car(r, cell_column + 0.5, cell_row + 0.5, &x, &y);
      if (x < x_from_m - reach || x > x_to_m + reach || y < y_from_m - reach || y > y_to_m + reach)
        continue;
      if (cell_column < 0 || cell_column >= IOGRID_SIDE || cell_row < 0 || cell_row >= IOGRID_SIDE)
        return 0;
      const int is = iogrid_cell(r, (uint32_t)cell_column, (uint32_t)cell_row) >> 3;
      if (is < IOGRID_DRIVABLE_FREE || is > IOGRID_FREE) return 0;
    }
  }
  return 1;
}

// Goes through the cells of a class: from *at = 0 on, false behind the last. A place is its middle.
static inline int iogrid_next(const iogrid_receiver* r, enum iogrid_class wanted, uint32_t* at,
                              double* x_m, double* y_m) {
  for (; r->has_pose && *at < IOGRID_SIDE * IOGRID_SIDE; ++*at) {
    const uint32_t column = *at % IOGRID_SIDE, row = *at / IOGRID_SIDE;
    if (iogrid_cell(r, column, row) >> 3 == (int)wanted) {
      iogrid_to_car(r, column + 0.5, row + 0.5, x_m, y_m);
      ++*at;
      return 1;
    }
  }
  return 0;
}

#endif
