// The tiles of a grid, of the messages of a frame (docs/spec.md, 3.3 to 3.6), for iogrid.h.
#ifndef IOGRID_GRID_H
#define IOGRID_GRID_H

#include <stddef.h>
#include <stdint.h>
#include <string.h>

#include "iogrid_tiles.h"

#define IOGRID_TILES 1024  // of a grid, at most

enum iogrid_drop {
  IOGRID_NOT_OURS,
  IOGRID_OTHER_VERSION,
  IOGRID_DAMAGED,    // lengths, data id or CRC of E2E Profile 4
  IOGRID_MALFORMED,  // or repeated
  IOGRID_OTHER_RUN,  // that is over, or not confirmed by three messages
  IOGRID_TOO_LATE,
  IOGRID_NOT_UNDERSTOOD,
  IOGRID_BAD_TILE,    // in a message that was used
  IOGRID_WRONG_NAME,  // a grid that is not the one that the target has named
  IOGRID_DROPS
};

typedef struct {  // by tile number, which for classes is not the place in the window
  uint8_t cells[IOGRID_TILES][IOGRID_CELLS];
  uint8_t is_lost[IOGRID_TILES];  // its cells are 0
  uint32_t columns, rows;         // cells; 0 before the first message
  double cell_m, x_m, y_m;        // and of indexes the lowest corner in the car's frame
  double epsilon;                 // of indexes
  uint32_t tiles;
  uint8_t geometry[18], says_geometry;  // its bytes, 3.3, and whether the frame has said them
  uint8_t are_classes, is_whole, has_end, has_window;
  uint8_t window[48];  // its header, 3.9
  uint32_t spoken_of, known, sent, not_sent, name;
  uint8_t own[IOGRID_TILES][IOGRID_CELLS];  // last sent without a reference, and in which frame
  uint32_t own_frame[IOGRID_TILES];
  uint8_t has_own[IOGRID_TILES];
} iogrid_grid;

static inline uint32_t iogrid_crc(const uint32_t* table, uint32_t crc, const uint8_t* at,
                                  size_t bytes) {
  for (; bytes > 0; --bytes) {
    crc = crc >> 8 ^ table[(crc ^ *at++) & 0xFF];
  }
  return crc;
}

static inline void iogrid_begin_grid(iogrid_grid* grid, int are_classes) {
  memset(grid->cells, 0, sizeof grid->cells);
  memset(grid->is_lost, 1, sizeof grid->is_lost);
  memset(grid->window, 0, sizeof grid->window);
  grid->are_classes = (uint8_t)are_classes;
  grid->is_whole = grid->has_end = grid->has_window = grid->says_geometry = 0;
  grid->spoken_of = grid->known = grid->sent = grid->not_sent = grid->name = 0;
}

// Whether a message's window is that of the frame; where it ends in the body, 0 if it is not.
static inline size_t iogrid_window(iogrid_grid* grid, const uint8_t* body, size_t bytes,
                                   size_t at) {
  if (bytes < at + 48) return 0;
  const size_t size = iogrid_be16(body + at);
  if (size < 48 || size > bytes - at) return 0;
  if (grid->has_window && memcmp(grid->window, body + at, 48) != 0) return 0;
  return at + size;
}

// The number of tiles of a grid with this geometry. 0 if the geometry is invalid or differs from
// that of the frame.
static inline uint32_t iogrid_tiles_of(const iogrid_grid* grid, const uint8_t* geometry) {
  const uint32_t columns = iogrid_be16(geometry + 2), rows = iogrid_be16(geometry + 4);
  const uint32_t tiles = columns / 32 * (rows / 32), epsilon_e5 = iogrid_be16(geometry + 8);
  if (geometry[0] != 5 || columns % 32 != 0 || rows % 32 != 0 || tiles > IOGRID_TILES) return 0;
  if (iogrid_be16(geometry + 6) == 0) return 0;
  if (!grid->are_classes && (epsilon_e5 == 0 || epsilon_e5 >= 50000)) return 0;
  return grid->says_geometry && memcmp(grid->geometry, geometry, 18) != 0 ? 0 : tiles;
}

static inline void iogrid_set_geometry(iogrid_grid* grid, const uint8_t* geometry) {
  if (memcmp(grid->geometry, geometry, 18) != 0) memset(grid->has_own, 0, sizeof grid->has_own);
  memcpy(grid->geometry, geometry, 18);
  grid->says_geometry = 1;
  grid->columns = iogrid_be16(geometry + 2);
  grid->rows = iogrid_be16(geometry + 4);
  grid->tiles = grid->columns / 32 * (grid->rows / 32);
  grid->cell_m = iogrid_be16(geometry + 6) * 1e-3;
  grid->epsilon = iogrid_be16(geometry + 8) * 1e-5;
  grid->x_m = (int32_t)iogrid_be32(geometry + 10) * 1e-3;
  grid->y_m = (int32_t)iogrid_be32(geometry + 14) * 1e-3;
}

// Takes what a message says of a grid's tiles; false, and nothing is changed, if it contradicts
// itself or what came before.
static inline int iogrid_take_tiles(iogrid_grid* grid, uint32_t frame, uint32_t* dropped,
                                    const uint8_t* body, size_t bytes, size_t at) {
  const size_t record = grid->are_classes ? 6 : 5, begin = at;
  const uint32_t first = iogrid_be16(body), end = iogrid_be16(body + 2);
  uint32_t lowest = first, count = 0;
  for (size_t size; at < bytes; at += record + size, ++count) {
    if (bytes - at < record) return 0;
    const uint32_t tile = iogrid_be16(body + at);
    size = iogrid_be16(body + at + record - 2);
    if (tile < lowest || tile >= end || size > IOGRID_CELLS || size > bytes - at - record) return 0;
    lowest = tile + 1;
  }
  const uint32_t tiles = iogrid_tiles_of(grid, body + 6);
  if (tiles == 0 || first > end || end > tiles || count != iogrid_be16(body + 4)) return 0;
  for (uint32_t tile = first; tile < end; ++tile) {
    if (!grid->is_lost[tile]) return 0;  // it has been spoken of
  }
  iogrid_set_geometry(grid, body + 6);
  memset(grid->is_lost + first, 0, end - first);
  grid->spoken_of += end - first;
  for (at = begin; at < bytes; at += record + iogrid_be16(body + at + record - 2)) {
    const uint32_t tile = iogrid_be16(body + at), encoding = body[at + 2];
    const uint8_t* payload = body + at + record;
    const size_t size = iogrid_be16(payload - 2);
    const uint32_t of = iogrid_reference(encoding, payload, size, frame);
    const int stands_alone = encoding != 5;
    int is_tile = (stands_alone || (grid->has_own[tile] && grid->own_frame[tile] == of)) &&
                  iogrid_tile(encoding, payload, size, grid->own[tile], grid->cells[tile]);
    for (uint32_t i = 0; is_tile && i < IOGRID_CELLS; ++i) {
      const uint8_t byte = grid->cells[tile][i];
      is_tile = grid->are_classes ? byte == 0 || (byte >= 8 && byte < 72) : byte != 0x80;
    }
    ++grid->known;
    if (!is_tile) {
      memset(grid->cells[tile], 0, IOGRID_CELLS);
      grid->is_lost[tile] = 1;
      ++dropped[IOGRID_BAD_TILE];
    } else if (stands_alone) {
      memcpy(grid->own[tile], grid->cells[tile], IOGRID_CELLS);
      grid->own_frame[tile] = frame;
      grid->has_own[tile] = 1;
    }
  }
  return 1;
}

// The name of a grid, 3.6 and 3.10.
static inline uint32_t iogrid_name(const iogrid_grid* grid, const uint32_t* table) {
  uint32_t crc = 0xFFFFFFFF, is_anything = 0;
  if (grid->has_window) crc = iogrid_crc(table, crc, grid->window + 4, 8);
  const uint32_t across = grid->columns / 32;
  for (uint32_t tile = 0; tile < grid->tiles; ++tile) {
    const uint32_t x = tile % across, y = tile / across;
    const uint8_t place[4] = {(uint8_t)(x >> 8), (uint8_t)x, (uint8_t)(y >> 8), (uint8_t)y};
    const uint8_t number[2] = {(uint8_t)(tile >> 8), (uint8_t)tile};
    uint32_t i = 0;
    while (i < IOGRID_CELLS && grid->cells[tile][i] == 0) ++i;
    if (i == IOGRID_CELLS) continue;
    crc = grid->are_classes ? iogrid_crc(table, crc, number, 2) : iogrid_crc(table, crc, place, 4);
    crc = iogrid_crc(table, crc, grid->cells[tile], IOGRID_CELLS);
    is_anything = 1;
  }
  return is_anything ? ~crc : 0;
}

static inline void iogrid_close_grid(iogrid_grid* grid, const uint32_t* table, uint32_t* dropped) {
  uint32_t lost = 0;
  for (uint32_t tile = 0; tile < grid->tiles; ++tile) lost += grid->is_lost[tile];
  grid->is_whole = grid->has_end && grid->tiles > 0 && lost == 0 && grid->not_sent == 0 &&
                   grid->known == grid->sent;
  if (grid->is_whole &&
      grid->name != iogrid_name(grid, table)) {  // nobody knows which cell is wrong
    memset(grid->cells, 0, sizeof grid->cells);
    memset(grid->is_lost, 1, sizeof grid->is_lost);
    memset(grid->has_own, 0, sizeof grid->has_own);
    grid->is_whole = 0;
    ++dropped[IOGRID_WRONG_NAME];
  }
}

// The offset in a frame end of the fields behind counters and sensors (3.5). 0 if the frame end is
// too short.
static inline size_t iogrid_end_tail(uint32_t sensors, const uint8_t* body, size_t bytes) {
  if (bytes < 32) return 0;
  size_t at = 32 + 4 * ((size_t)body[28] + body[29] + body[30] + body[31]);
  if (at >= bytes) return 0;
  at += 4 + (size_t)sensors * body[at];
  return at + 24 <= bytes ? at : 0;
}

#endif
