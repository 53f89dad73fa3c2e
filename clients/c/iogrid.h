// Reads the stream of an iogrid target, interface version 5, and answers questions about a
// frame: C99 or C++, no allocation. Numbers like 3.9 are sections of docs/spec.md. Places are
// metres in the car's frame, x forward and y to the left. docs/clients.md has examples; link with
// -lm.
#ifndef IOGRID_H
#define IOGRID_H

#include <math.h>
#include <stdint.h>

#include "iogrid_receiver.h"

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

// Whether the bits have one of the sectors that the directions touch; true if they are no sector.
static inline int iogrid_has_sector(uint64_t bits, double from_rad, double to_rad) {
  const double sectors_per_rad = 64 / 6.283185307179586;
  const double first = floor(from_rad * sectors_per_rad), last = floor(to_rad * sectors_per_rad);
  if (!(first <= last && last - first <= 64 && fabs(first) < 1e6)) return 1;
  for (int i = (int)first; i <= (int)last; ++i) {
    if (bits >> ((unsigned)i & 63) & 1) return 1;
  }
  return 0;
}

// Whether sensors watch every direction from the one to the other now, counter-clockwise from
// straight ahead: -0.2 to 0.2 is the sector ahead. What is not known is not watched.
static inline int iogrid_is_watched(const iogrid_receiver* r, double from_rad, double to_rad) {
  return r->knows_unwatched && !iogrid_has_sector(r->unwatched, from_rad, to_rad);
}

// Whether a sensor that looks there is covered by a cap, ice or mud; open sky does not count.
// Another sensor may watch there nevertheless.
static inline int iogrid_is_blocked(const iogrid_receiver* r, double from_rad, double to_rad) {
  return iogrid_has_sector(r->blocked, from_rad, to_rad);
}

// The occupancy index of a place: above 0 occupied, below free, 0 unknown or outside.
static inline int iogrid_index_at(const iogrid_receiver* r, double x_m, double y_m) {
  const iogrid_grid* grid = &r->indexes;
  if (grid->columns == 0) return 0;
  const double x = floor(x_m / grid->cell_m) - floor(grid->x_m / grid->cell_m + 0.5);
  const double y = floor(y_m / grid->cell_m) - floor(grid->y_m / grid->cell_m + 0.5);
  if (!(x >= 0 && x < grid->columns && y >= 0 && y < grid->rows)) return 0;
  const uint32_t column = (uint32_t)x, row = (uint32_t)y;
  const uint32_t tile = row / 32 * (grid->columns / 32) + column / 32;
  return (int8_t)grid->cells[tile][row % 32 * 32 + column % 32];
}

// The probability that a cell with this index is occupied, from the epsilon of the stream (3.3).
static inline double iogrid_probability(const iogrid_receiver* r, int index) {
  return 1 / (1 + pow((0.5 - r->indexes.epsilon) / (0.5 + r->indexes.epsilon), index));
}

// The non-negative remainder.
static inline uint32_t iogrid_modulo(int64_t number, uint32_t by) {
  return (uint32_t)((number % by + by) % by);
}

// The class byte of a cell of the window, row by row from its lowest x and y: class * 8 + sureness.
static inline uint8_t iogrid_cell(const iogrid_receiver* r, uint32_t column, uint32_t row) {
  const uint32_t across = r->classes.columns / 32, up = r->classes.rows / 32;
  const uint32_t tile = iogrid_modulo((int64_t)r->window_row + row / 32, up) * across +
                        iogrid_modulo((int64_t)r->window_column + column / 32, across);
  return r->classes.cells[tile][row % 32 * 32 + column % 32];
}

// Column and row of a place, with fractions; only if has_pose.
static inline void iogrid_to_cell(const iogrid_receiver* r, double x_m, double y_m, double* column,
                                  double* row) {
  const double c = cos(r->heading_rad), s = sin(r->heading_rad);
  *column = (r->x_m + c * x_m - s * y_m) / r->classes.cell_m - 32.0 * r->window_column;
  *row = (r->y_m + s * x_m + c * y_m) / r->classes.cell_m - 32.0 * r->window_row;
}

// The place in the car's frame of one in the local frame, both m; only if has_pose.
static inline void iogrid_seen_from_car(const iogrid_receiver* r, double local_x_m,
                                        double local_y_m, double* x_m, double* y_m) {
  const double c = cos(r->heading_rad), s = sin(r->heading_rad);
  const double x = local_x_m - r->x_m, y = local_y_m - r->y_m;
  *x_m = c * x + s * y;
  *y_m = c * y - s * x;
}

static inline void iogrid_to_car(const iogrid_receiver* r, double column, double row, double* x_m,
                                 double* y_m) {
  iogrid_seen_from_car(r, (column + 32.0 * r->window_column) * r->classes.cell_m,
                       (row + 32.0 * r->window_row) * r->classes.cell_m, x_m, y_m);
}

static inline void iogrid_from_local(const iogrid_receiver* r, int32_t x_mm, int32_t y_mm,
                                     double* x_m, double* y_m) {
  iogrid_seen_from_car(r, x_mm * 1e-3, y_mm * 1e-3, x_m, y_m);
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
  if (!(column >= 0 && column < r->classes.columns && row >= 0 && row < r->classes.rows))
    return IOGRID_UNKNOWN;
  return (enum iogrid_class)(iogrid_cell(r, (uint32_t)column, (uint32_t)row) >> 3);
}

// Whether each cell that touches the rectangle is free. What is unknown, lost or outside is not.
static inline int iogrid_is_free(const iogrid_receiver* r, double x_from_m, double x_to_m,
                                 double y_from_m, double y_to_m) {
  const double reach = r->classes.cell_m * 0.70710678118654757;  // of a cell from its middle
  const double furthest = fmax(r->classes.columns, r->classes.rows) * r->classes.cell_m * 2;
  double column, row, x, y;
  if (!r->has_pose || !(x_from_m <= x_to_m && y_from_m <= y_to_m)) return 0;
  if (x_from_m < -furthest || x_to_m > furthest || y_from_m < -furthest || y_to_m > furthest)
    return 0;
  iogrid_to_cell(r, (x_from_m + x_to_m) / 2, (y_from_m + y_to_m) / 2, &column, &row);
  const int half = (int)(hypot(x_to_m - x_from_m, y_to_m - y_from_m) / 2 / r->classes.cell_m) + 2;
  for (int i = -half; i <= half; ++i) {
    for (int j = -half; j <= half; ++j) {
      const double cell_column = floor(column) + j, cell_row = floor(row) + i;
      iogrid_to_car(r, cell_column + 0.5, cell_row + 0.5, &x, &y);
      if (x < x_from_m - reach || x > x_to_m + reach || y < y_from_m - reach || y > y_to_m + reach)
        continue;
      if (cell_column < 0 || cell_column >= r->classes.columns || cell_row < 0 ||
          cell_row >= r->classes.rows)
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
  for (; r->has_pose && *at < r->classes.columns * r->classes.rows; ++*at) {
    const uint32_t column = *at % r->classes.columns, row = *at / r->classes.columns;
    if (iogrid_cell(r, column, row) >> 3 == (int)wanted) {
      iogrid_to_car(r, column + 0.5, row + 0.5, x_m, y_m);
      ++*at;
      return 1;
    }
  }
  return 0;
}

#endif
