// The frames of a stream, of its messages (docs/spec.md, 3.1 to 3.12), for iogrid.h.
//
// The messages of a frame may come in any order. A frame ends when it is complete, or with the
// first message of a newer one; what was lost of it is unknown then, and never older than it. Bytes
// that do not follow the specification are dropped and counted, whatever they are.
#ifndef IOGRID_RECEIVER_H
#define IOGRID_RECEIVER_H

#include <stddef.h>
#include <stdint.h>
#include <string.h>

#include "iogrid_grid.h"
#include "iogrid_objects.h"

enum iogrid_result {
  IOGRID_NONE,
  IOGRID_FRAME,       // the frame is in the receiver, until the next call
  IOGRID_FRAME_AGAIN  // likewise, as far as it has come; and the same datagram is to be given again
};

typedef struct {  // some 4 MiB; iogrid_init() first
  uint32_t number, vehicle, run, points_used;
  uint64_t closed_us;         // by the target's clock
  uint8_t complete, partial;  // bit i: sensor i has delivered its scan, or a part of it
  uint8_t knows_unwatched;    // false: the frame's end was lost
  int16_t temperature_dc;     // of the chip, 1/10 degree Celsius; or IOGRID_NO_TEMPERATURE
  uint64_t unwatched;         // bit i: no sensor watches sector i of 64 around the car now (3.5)
  uint64_t blocked;           // likewise: nearly nothing comes back to some sensor; 0: not known
  uint8_t has_indexes, has_classes, has_objects, is_whole;
  iogrid_grid indexes, classes;
  iogrid_object_list objects;         // iogrid_objects() reads them
  uint16_t causes;                    // 3.9
  int32_t window_column, window_row;  // tiles: the window's lowest corner in the local frame
  uint8_t has_pose;              // else it is not known where the car is, and no class has a place
  double x_m, y_m, heading_rad;  // of the car in the local frame
  uint64_t end_us;               // of the pose, by the poses' clock
  uint8_t has_velocity;          // of the car since the frame before
  double vx_m_s, vy_m_s;         // in the local frame
  uint32_t used, dropped[IOGRID_DROPS];  // messages and tiles
  char refusal[256];  // why the target has refused its car and sends no grid (3.11), or empty
  // The receiver's own.
  uint8_t is_open, has_run, has_next, had_pose, contents;
  uint32_t number_before;
  int32_t x_mm_before, y_mm_before;
  uint64_t end_us_before;
  uint32_t next, over[16], overs, candidate, candidates, candidate_sequences[2];
  uint32_t crc[256];  // table of CRC-32/P4, 3.1
} iogrid_receiver;

enum { IOGRID_NO_TEMPERATURE = -32768 };
enum iogrid_contents { IOGRID_HAS_CLASSES = 4, IOGRID_NO_INDEXES = 8, IOGRID_HAS_OBJECTS = 16 };

enum iogrid_kind {  // of a message, 3.2
  IOGRID_KIND_TILES = 1,
  IOGRID_KIND_END,
  IOGRID_KIND_END_OF_CLASSES,
  IOGRID_KIND_REFUSAL,
  IOGRID_KIND_OBJECTS,
  IOGRID_KIND_RECEPTIONS  // for a PC that repeats the target's run
};

static inline void iogrid_init(iogrid_receiver* r) {
  memset(r, 0, sizeof *r);
  for (uint32_t i = 0; i < 256; ++i) {
    r->crc[i] = i;
    for (int bit = 0; bit < 8; ++bit) {
      r->crc[i] = r->crc[i] >> 1 ^ (r->crc[i] & 1 ? 0xC8DF352FU : 0);
    }
  }
}

// The car's velocity since the frame before; not over a jump, since the local frame may be another.
static inline void iogrid_follow_car(iogrid_receiver* r, int32_t x_mm, int32_t y_mm) {
  const uint64_t passed = r->end_us - r->end_us_before;  // us
  r->has_velocity = r->has_pose && r->had_pose && r->number == r->number_before + 1 && passed > 0 &&
                    passed <= 500000 && (r->causes & 0xDA) == 0;
  r->vx_m_s = r->has_velocity ? ((double)x_mm - r->x_mm_before) * 1000 / (double)passed : 0;
  r->vy_m_s = r->has_velocity ? ((double)y_mm - r->y_mm_before) * 1000 / (double)passed : 0;
  r->had_pose = r->has_pose;
  r->number_before = r->number;
  r->x_mm_before = x_mm;
  r->y_mm_before = y_mm;
  r->end_us_before = r->end_us;
}

// Where the car is, by the header of the window; zeros of a frame without one.
static inline void iogrid_place_car(iogrid_receiver* r) {
  static const uint8_t unknown[16] = {0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 255, 255, 255, 255};
  const uint8_t* w = r->classes.window;
  const int32_t x_mm = (int32_t)iogrid_be32(w + 12), y_mm = (int32_t)iogrid_be32(w + 16);
  r->causes = (uint16_t)iogrid_be16(w + 2);
  r->window_column = (int32_t)iogrid_be32(w + 4);
  r->window_row = (int32_t)iogrid_be32(w + 8);
  r->has_pose = r->classes.has_window && memcmp(w + 12, unknown, 16) != 0;
  r->x_m = x_mm * 1e-3;
  r->y_m = y_mm * 1e-3;
  r->heading_rad = iogrid_be32(w + 20) * 1.4629180792671596e-9;  // 2 pi / 2^32
  r->end_us = iogrid_be64(w + 40);
  iogrid_follow_car(r, x_mm, y_mm);
}

// Hands over what has come of the frame. Also for who has heard nothing for half a second: then
// nothing is of now. False if there is none.
static inline int iogrid_close(iogrid_receiver* r) {
  if (!r->is_open) return 0;
  r->is_open = 0;
  r->next = r->number + 1;
  if (r->has_indexes) iogrid_close_grid(&r->indexes, r->crc, r->dropped);
  if (r->has_classes) iogrid_close_grid(&r->classes, r->crc, r->dropped);
  r->is_whole = r->indexes.has_end && (!r->has_indexes || r->indexes.is_whole) &&
                (!r->has_classes || r->classes.is_whole) &&
                (!r->has_objects || iogrid_are_objects_complete(&r->objects));
  iogrid_place_car(r);
  return 1;
}

static inline void iogrid_open(iogrid_receiver* r, uint32_t number, uint8_t contents) {
  r->is_open = r->has_next = 1;
  r->next = r->number = number;
  r->contents = contents;
  r->has_classes = (contents & IOGRID_HAS_CLASSES) != 0;
  r->has_indexes = (contents & IOGRID_NO_INDEXES) == 0;
  r->has_objects = (contents & IOGRID_HAS_OBJECTS) != 0;
  iogrid_begin_grid(&r->indexes, 0);
  iogrid_begin_grid(&r->classes, 1);
  memset(&r->objects, 0, sizeof r->objects);
  r->knows_unwatched = 0;
  r->temperature_dc = IOGRID_NO_TEMPERATURE;
  r->blocked = 0;
}

static inline int iogrid_is_spoken_of(const iogrid_grid* grid) {
  return grid->says_geometry && grid->spoken_of == grid->tiles;
}

// Whether nothing is to come any more of the frame that is open.
static inline int iogrid_has_come(const iogrid_receiver* r) {
  const iogrid_grid *indexes = &r->indexes, *classes = &r->classes;
  return indexes->has_end && (!r->has_indexes || iogrid_is_spoken_of(indexes)) &&
         (!r->has_classes || (classes->has_end && iogrid_is_spoken_of(classes))) &&
         (!r->has_objects || iogrid_are_objects_complete(&r->objects));
}

// Takes what a message says of a grid; false, and nothing is changed, if it contradicts itself or
// what came before.
static inline int iogrid_take_grid(iogrid_receiver* r, const uint8_t* content, const uint8_t* body,
                                   size_t bytes) {
  const int are_tiles = content[0] == IOGRID_KIND_TILES;
  if (are_tiles && bytes < 24) return 0;
  const int are_classes =
      are_tiles ? body[7] == 2 : content[0] == IOGRID_KIND_END_OF_CLASSES;  // storage, 3.3
  if (are_tiles && !are_classes && body[7] != 0) return 0;
  if (are_classes ? !r->has_classes : are_tiles && !r->has_indexes) return 0;
  iogrid_grid* grid = are_classes ? &r->classes : &r->indexes;
  size_t at = are_tiles ? 24 : 0;
  const uint8_t* window = body + at;
  if (are_classes && (at = iogrid_window(grid, body, bytes, at)) == 0) return 0;
  const size_t tail = are_tiles || are_classes ? at : iogrid_end_tail(content[24], body, bytes);
  if (are_tiles ? !iogrid_take_tiles(grid, r->number, r->dropped, body, bytes, at)
                : bytes - at < 12 || (!are_classes && tail == 0))
    return 0;
  if (are_classes) memcpy(grid->window, window, sizeof grid->window);
  grid->has_window = (uint8_t)are_classes;
  if (are_tiles) return 1;
  grid->sent = iogrid_be32(body + at);
  grid->not_sent = iogrid_be32(body + at + 4);
  grid->name = iogrid_be32(body + at + 8);
  grid->has_end = 1;
  if (!are_classes) {
    const uint8_t* after = body + tail;
    r->knows_unwatched = 1;
    r->unwatched = iogrid_be64(after);
    r->blocked = iogrid_be64(after + 8);
    r->temperature_dc = (int16_t)iogrid_be16(after + 16);
  }
  return 1;
}

// Why a datagram is no message of a stream (3.1, 3.2); IOGRID_DROPS if it is one.
static inline enum iogrid_drop iogrid_fault(const iogrid_receiver* r, const uint8_t* m,
                                            size_t bytes) {
  const uint8_t* content = m + 28;
  if (bytes < 28 || iogrid_be32(m) != 0x4F478001U || m[12] != 1) return IOGRID_NOT_OURS;
  if (m[13] != 5) return IOGRID_OTHER_VERSION;
  if (bytes > 1392 || iogrid_be32(m + 4) != bytes - 8 || iogrid_be16(m + 16) != bytes - 8 ||
      m[14] != 2 || m[15] != 0 || iogrid_be32(m + 20) != 0x494F4701U)
    return IOGRID_DAMAGED;
  const uint32_t crc = iogrid_crc(r->crc, 0xFFFFFFFF, m + 8, 16);
  if (iogrid_be32(m + 24) != ~iogrid_crc(r->crc, crc, content, bytes - 28)) return IOGRID_DAMAGED;
  if (bytes < 76 || iogrid_be16(content + 2) < 48 || iogrid_be16(content + 2) > bytes - 28 ||
      iogrid_be16(m + 18) != iogrid_be16(content + 6))
    return IOGRID_MALFORMED;
  return IOGRID_DROPS;
}

enum iogrid_whose { IOGRID_OF_NO_RUN, IOGRID_OF_THE_RUN, IOGRID_OF_A_NEW_RUN };

// Of which run a message is (3.2); the third message in a row of another one makes it the newest.
static inline enum iogrid_whose iogrid_whose_is(iogrid_receiver* r, uint32_t run,
                                                uint32_t sequence) {
  if (!r->has_run || run == r->run) {
    r->has_run = 1;
    r->run = run;
    r->candidates = 0;
    return IOGRID_OF_THE_RUN;
  }
  for (uint32_t i = 0; i < r->overs && i < 16; ++i) {
    if (r->over[i] == run) return IOGRID_OF_NO_RUN;
  }
  if (run != r->candidate) r->candidates = 0;
  r->candidate = run;
  for (uint32_t i = 0; i < r->candidates; ++i) {
    if (r->candidate_sequences[i] == sequence) return IOGRID_OF_NO_RUN;
  }
  if (r->candidates == 2) return IOGRID_OF_A_NEW_RUN;
  r->candidate_sequences[r->candidates++] = sequence;
  return IOGRID_OF_NO_RUN;
}

static inline void iogrid_begin_run(iogrid_receiver* r, uint32_t run) {
  r->over[r->overs++ % 16] = r->run;
  r->run = run;
  r->candidates = 0;
  r->has_next = r->had_pose = 0;
  r->refusal[0] = 0;
  memset(&r->indexes, 0, sizeof r->indexes);
  memset(&r->classes, 0, sizeof r->classes);
}

static inline enum iogrid_result iogrid_drop_it(iogrid_receiver* r, enum iogrid_drop cause) {
  ++r->dropped[cause];
  return IOGRID_NONE;
}

// Takes a datagram, whatever its bytes are. `while (iogrid_take(...) == IOGRID_FRAME_AGAIN)` around
// it sees every frame.
static inline enum iogrid_result iogrid_take(iogrid_receiver* r, const void* datagram,
                                             size_t bytes) {
  const uint8_t *m = (const uint8_t*)datagram, *content = m + 28;
  const enum iogrid_drop fault = iogrid_fault(r, m, bytes);
  if (fault != IOGRID_DROPS) return iogrid_drop_it(r, fault);
  const uint8_t* body = content + iogrid_be16(content + 2);
  const size_t body_bytes = bytes - (size_t)(body - m);
  const uint32_t number = iogrid_be32(content + 8), run = iogrid_be32(content + 44);
  const enum iogrid_whose whose = iogrid_whose_is(r, run, iogrid_be32(content + 4));
  if (whose == IOGRID_OF_NO_RUN) return iogrid_drop_it(r, IOGRID_OTHER_RUN);
  if (whose == IOGRID_OF_A_NEW_RUN) {
    if (iogrid_close(r)) return IOGRID_FRAME_AGAIN;
    iogrid_begin_run(r, run);
  }
  if (content[0] == IOGRID_KIND_REFUSAL && body_bytes >= 4 && body_bytes - 4 >= body[1]) {
    memcpy(r->refusal, body + 4, body[1]);
    r->refusal[body[1]] = 0;
    return IOGRID_NONE;
  }
  if (content[0] == IOGRID_KIND_RECEPTIONS) {
    ++r->used;
    return IOGRID_NONE;
  }
  if (content[0] < IOGRID_KIND_TILES || content[0] > IOGRID_KIND_OBJECTS ||
      content[0] == IOGRID_KIND_REFUSAL)
    return iogrid_drop_it(r, IOGRID_NOT_UNDERSTOOD);
  if (r->has_next && number - r->next >= 0x80000000U) return iogrid_drop_it(r, IOGRID_TOO_LATE);
  if (r->is_open && number != r->number) {
    iogrid_close(r);
    return IOGRID_FRAME_AGAIN;
  }
  const uint8_t contents =
      content[1] & (IOGRID_HAS_CLASSES | IOGRID_NO_INDEXES | IOGRID_HAS_OBJECTS);
  if (!r->is_open) iogrid_open(r, number, contents);
  if (contents != r->contents) return iogrid_drop_it(r, IOGRID_MALFORMED);
  const int is_taken = content[0] == IOGRID_KIND_OBJECTS
                           ? r->has_objects && iogrid_take_objects(&r->objects, body, body_bytes)
                           : iogrid_take_grid(r, content, body, body_bytes);
  if (!is_taken) return iogrid_drop_it(r, IOGRID_MALFORMED);
  ++r->used;
  r->closed_us = iogrid_be64(content + 12);
  r->vehicle = iogrid_be32(content + 20);
  r->complete = content[25];
  r->partial = content[26];
  r->points_used = iogrid_be32(content + 28);
  if (!iogrid_has_come(r)) return IOGRID_NONE;
  iogrid_close(r);
  return IOGRID_FRAME;
}

#endif
