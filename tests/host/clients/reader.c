// Prints what clients/c makes of datagrams: a line for each frame. Standard input: u16 big endian
// bytes of a datagram, and the datagram.
#include <stdio.h>
#include <stdlib.h>

#include "iogrid.h"

static iogrid_receiver receiver;
static uint8_t datagram[65536];
static uint32_t zlib_crc[256];

static uint32_t lost(const iogrid_grid* grid) {
  uint32_t tiles = 0;
  for (uint32_t tile = 0; tile < grid->tiles; ++tile) tiles += grid->is_lost[tile];
  return tiles;
}

// CRC-32 of the cells row by row.
static uint32_t picture(const iogrid_receiver* r, int of_classes) {
  uint32_t crc = 0xFFFFFFFF;
  const iogrid_grid* grid = of_classes ? &r->classes : &r->indexes;
  for (uint32_t row = 0; row < grid->rows; ++row) {
    for (uint32_t column = 0; column < grid->columns; ++column) {
      const uint8_t cell =
          of_classes ? iogrid_cell(r, column, row)
                     : (uint8_t)iogrid_index_at(r, grid->x_m + (column + 0.5) * grid->cell_m,
                                                grid->y_m + (row + 0.5) * grid->cell_m);
      crc = iogrid_crc(zlib_crc, crc, &cell, 1);
    }
  }
  return ~crc;
}

// How many objects there are, and the CRC-32 of what is said of each, half a second later, too.
static void print_objects(const iogrid_receiver* r) {
  static iogrid_object all[IOGRID_OBJECTS];
  const int count = iogrid_objects(r, all, IOGRID_OBJECTS);
  uint32_t crc = 0xFFFFFFFF;
  for (int i = 0; i < count; ++i) {
    const iogrid_object* o = &all[i];
    char text[300];
    int32_t x = 0, y = 0;
    uint32_t sigma = 0;
    const int is_told = iogrid_object_at(o, o->time_us + 512345, &x, &y, &sigma);
    const int bytes = snprintf(
        text, sizeof text,
        "%llu %u %u %u %u %d %d %u %u %d %u %u %d %d %u %u %u %u %u %u %d %d %d %u\n",
        (unsigned long long)o->time_us, o->id, o->state, o->existence, o->age, o->x_mm, o->y_mm,
        o->length_cm, o->width_cm, o->has_heading ? o->heading : -1, o->is_hit, o->is_end_hidden,
        o->vx_cm_s, o->vy_cm_s, o->sigma_v_along, o->sigma_v_across, o->sigma_along,
        o->sigma_across, o->since_hit_ms, o->since_stopped, is_told, x, y, sigma);
    crc = iogrid_crc(zlib_crc, crc, (const uint8_t*)text, (size_t)bytes);
  }
  printf(" objects %d %08x", count, ~crc);
}

static void print(const iogrid_receiver* r) {
  uint32_t at = 0, moving = 0, is_free = 0;
  double x, y, sum = 0;
  while (iogrid_next(r, IOGRID_MOVING, &at, &x, &y)) {
    ++moving;
    sum += x + 2 * y;
  }
  for (int i = 0; i < 200; ++i) {
    x = -20 + i * 0.2137;
    y = -5 + i % 7 * 1.377;
    is_free += (uint32_t)iogrid_is_free(r, x, x + i % 5 * 0.613, y, y + i % 3 * 0.797) << i % 16;
  }
  printf("%u run %u whole %d lost %u %u cells %08x %08x", r->number, r->run, r->is_whole,
         r->has_indexes ? lost(&r->indexes) : 0, r->has_classes ? lost(&r->classes) : 0,
         picture(r, 0), picture(r, 1));
  printf(" p(3) %.6f", r->indexes.epsilon > 0 ? iogrid_probability(r, 3) : 0);
  print_objects(r);
  uint32_t is_watched = 0, is_blocked = 0;
  for (int i = 0; i < 32; ++i) {
    const double from = -3.3 + i * 0.213, to = from + i % 4 * 0.31;
    is_watched |= (uint32_t)iogrid_is_watched(r, from, to) << i;
    is_blocked |= (uint32_t)iogrid_is_blocked(r, from, to) << i;
  }
  printf(" unwatched %d %016llx watched %08x", r->knows_unwatched,
         r->knows_unwatched ? (unsigned long long)r->unwatched : 0ULL, is_watched);
  printf(" blocked %016llx %08x", (unsigned long long)r->blocked, is_blocked);
  printf(" chip %d", r->temperature_dc);
  printf(
      " causes %x pose %d %.3f %.3f %.6f end %llu moving %u %.3f free %u at %d car %d %.3f %.3f\n",
      r->causes, r->has_pose, r->has_pose ? r->x_m : 0, r->has_pose ? r->y_m : 0,
      r->has_pose ? r->heading_rad : 0, (unsigned long long)r->end_us, moving, sum, is_free,
      (int)iogrid_class_at(r, 5.03, 0.71), r->has_velocity, r->vx_m_s, r->vy_m_s);
}

int main(void) {
  iogrid_init(&receiver);
  for (uint32_t i = 0; i < 256; ++i) {
    zlib_crc[i] = i;
    for (int bit = 0; bit < 8; ++bit) {
      zlib_crc[i] = zlib_crc[i] >> 1 ^ (zlib_crc[i] & 1 ? 0xEDB88320U : 0);
    }
  }
  for (int high; (high = getchar()) != EOF;) {
    const size_t bytes = (size_t)high << 8 | (size_t)getchar();
    // On the heap, so that a byte read beyond its end is found.
    uint8_t* exact = (uint8_t*)malloc(bytes + (bytes == 0));
    if (exact == NULL || fread(datagram, 1, bytes, stdin) != bytes) return 1;
    memcpy(exact, datagram, bytes);
    enum iogrid_result result;
    while ((result = iogrid_take(&receiver, exact, bytes)) == IOGRID_FRAME_AGAIN) print(&receiver);
    if (result == IOGRID_FRAME) print(&receiver);
    free(exact);
  }
  if (iogrid_close(&receiver)) print(&receiver);
  uint32_t dropped = 0;
  for (int i = 0; i < IOGRID_BAD_TILE; ++i) dropped += receiver.dropped[i];
  printf("used %u dropped %u\n", receiver.used, dropped);
  return 0;
}
