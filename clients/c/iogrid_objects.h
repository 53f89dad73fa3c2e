// Things with a speed, of the messages of a frame (docs/spec.md, 3.12), for iogrid.h.
#ifndef IOGRID_OBJECTS_H
#define IOGRID_OBJECTS_H

#include <stddef.h>
#include <stdint.h>
#include <string.h>

#include "iogrid_tiles.h"

#define IOGRID_OBJECTS 256  // of a frame at most
#define IOGRID_OBJECT_PARTS 8
#define IOGRID_OF_A_PART 32

enum iogrid_state {  // a velocity is believed of the last two alone
  IOGRID_IS_YOUNG = 1,
  IOGRID_STANDS,
  IOGRID_MOVES,
  IOGRID_HAS_STOPPED
};

// A box on the ground. Places and velocities are of the local frame;
// iogrid_from_local() finds them in the car's.
typedef struct {
  uint64_t time_us;    // when it is where it is said to be, by the poses' clock
  uint32_t id;         // of no other thing of the run
  uint8_t state;       // enum iogrid_state
  uint8_t existence;   // how sure it is that it moves, 0 ... 255
  uint16_t age;        // frames in which it was measured
  int32_t x_mm, y_mm;  // its middle
  uint16_t length_cm, width_cm;
  uint16_t heading;  // 2^-16 turns, counter-clockwise from x
  uint8_t has_heading, is_hit, is_end_hidden;
  int16_t vx_cm_s, vy_cm_s;                // 0 but for what moves
  uint16_t sigma_v_along, sigma_v_across;  // cm/s; 65535: its velocity is not believed
  uint16_t sigma_along, sigma_across;      // mm, of its place
  uint16_t since_hit_ms, since_stopped;    // 10 ms; 65535: or more, and of what has not stopped
} iogrid_object;

typedef struct {  // the parts of a list as they came
  uint8_t says[16], counts[IOGRID_OBJECT_PARTS], came[IOGRID_OBJECT_PARTS];
  uint8_t parts, has_come;
  uint16_t objects;
  uint8_t records[IOGRID_OBJECT_PARTS][IOGRID_OF_A_PART][40];
} iogrid_object_list;

static inline int iogrid_are_objects_complete(const iogrid_object_list* list) {
  return list->has_come > 0 && list->has_come == list->parts;
}

// Whether a record can be believed.
static inline int iogrid_is_object(const uint8_t* record) {
  const int state = record[4], is_believed = state == IOGRID_MOVES || state == IOGRID_HAS_STOPPED;
  return iogrid_be32(record) > 0 && state >= IOGRID_IS_YOUNG && state <= IOGRID_HAS_STOPPED &&
         (state == IOGRID_MOVES || iogrid_be32(record + 24) == 0) &&
         (iogrid_be16(record + 28) != 65535) == is_believed &&
         (iogrid_be16(record + 30) != 65535) == is_believed;
}

// Takes a message; false, and nothing is changed, if it contradicts itself or what came before.
static inline int iogrid_take_objects(iogrid_object_list* list, const uint8_t* body, size_t bytes) {
  if (bytes < 24) return 0;
  const size_t head = iogrid_be16(body), size = iogrid_be16(body + 2);
  const uint32_t total = iogrid_be16(body + 4), number = body[6], parts = body[7];
  uint8_t says[16];
  memcpy(says, body + 4, 16);
  says[2] = 0;  // the number
  if (head < 24 || head > bytes || size < 40 || (bytes - head) % size != 0) return 0;
  const size_t count = (bytes - head) / size, others = parts - 1U;
  if (number >= parts || parts > IOGRID_OBJECT_PARTS || count > IOGRID_OF_A_PART) return 0;
  if (total > 0 && iogrid_be64(body + 8) == 0) return 0;
  if (others == 0
          ? count != total
          : count == 0 || total < count + others || total - count > others * IOGRID_OF_A_PART)
    return 0;
  if (list->has_come > 0 && memcmp(list->says, says, 16) != 0) return 0;
  if (list->came[number] || list->objects + count > total ||
      (list->has_come + 1U == parts && list->objects + count != total))
    return 0;
  uint32_t lowest = 1, highest = 0xFFFFFFFF;  // ids that are left by the parts before and behind
  for (uint32_t part = 0; part < parts; ++part) {
    if (!list->came[part] || list->counts[part] == 0) continue;
    if (part < number) lowest = iogrid_be32(list->records[part][list->counts[part] - 1]) + 1;
    if (part > number && highest == 0xFFFFFFFF) highest = iogrid_be32(list->records[part][0]) - 1;
  }
  uint32_t before = lowest - 1;
  for (size_t i = 0; i < count; ++i) {
    const uint8_t* record = body + head + i * size;
    const uint32_t id = iogrid_be32(record);
    if (!iogrid_is_object(record) || id <= before || id > highest) return 0;
    before = id;
  }
  for (size_t i = 0; i < count; ++i) memcpy(list->records[number][i], body + head + i * size, 40);
  memcpy(list->says, says, 16);
  list->came[number] = 1;
  list->counts[number] = (uint8_t)count;
  list->parts = (uint8_t)parts;
  list->objects = (uint16_t)(list->objects + count);
  ++list->has_come;
  return 1;
}

static inline int32_t iogrid_signed16(const uint8_t* at) {
  const int32_t value = (int32_t)iogrid_be16(at);
  return value < 32768 ? value : value - 65536;
}

static inline iogrid_object iogrid_read_object(const uint8_t* record, uint64_t time_us) {
  iogrid_object object;
  const uint32_t flags = iogrid_be16(record + 22);
  object.time_us = time_us;
  object.id = iogrid_be32(record);
  object.state = record[4];
  object.existence = record[5];
  object.age = (uint16_t)iogrid_be16(record + 6);
  object.x_mm = (int32_t)iogrid_be32(record + 8);
  object.y_mm = (int32_t)iogrid_be32(record + 12);
  object.length_cm = (uint16_t)iogrid_be16(record + 16);
  object.width_cm = (uint16_t)iogrid_be16(record + 18);
  object.heading = (uint16_t)iogrid_be16(record + 20);
  object.has_heading = (flags & 1) != 0;
  object.is_hit = (flags & 2) == 0;
  object.is_end_hidden = (flags & 4) != 0;
  object.vx_cm_s = (int16_t)iogrid_signed16(record + 24);
  object.vy_cm_s = (int16_t)iogrid_signed16(record + 26);
  object.sigma_v_along = (uint16_t)iogrid_be16(record + 28);
  object.sigma_v_across = (uint16_t)iogrid_be16(record + 30);
  object.sigma_along = (uint16_t)iogrid_be16(record + 32);
  object.sigma_across = (uint16_t)iogrid_be16(record + 34);
  object.since_hit_ms = (uint16_t)iogrid_be16(record + 36);
  object.since_stopped = (uint16_t)iogrid_be16(record + 38);
  return object;
}

// Where it is at a time of the poses' clock if it keeps its velocity, and the largest standard
// deviation that what was said allows. False, and nothing is changed, where its velocity is not
// believed, and for a time that is more than 10 s away.
static inline int iogrid_object_at(const iogrid_object* object, uint64_t time_us, int32_t* x_mm,
                                   int32_t* y_mm, uint32_t* sigma_mm) {
  const int is_later = time_us >= object->time_us;
  const uint64_t away = is_later ? time_us - object->time_us : object->time_us - time_us;
  if ((object->state != IOGRID_MOVES && object->state != IOGRID_HAS_STOPPED) || away > 10000000)
    return 0;
  // cm/s times us are 10^5 mm; half a mm up, rounded down. 2^34 mm keep the dividend above 0.
  const int64_t passed = is_later ? (int64_t)away : -(int64_t)away;
  const int64_t up = 17179869184;
  const int64_t x = ((int64_t)object->x_mm + up) * 100000 + object->vx_cm_s * passed + 50000;
  const int64_t y = ((int64_t)object->y_mm + up) * 100000 + object->vy_cm_s * passed + 50000;
  const uint64_t along = object->sigma_along + (object->sigma_v_along * away + 99999) / 100000;
  const uint64_t across = object->sigma_across + (object->sigma_v_across * away + 99999) / 100000;
  *x_mm = (int32_t)(x / 100000 - up);
  *y_mm = (int32_t)(y / 100000 - up);
  *sigma_mm = (uint32_t)(along > across ? along : across);
  return 1;
}

#endif
