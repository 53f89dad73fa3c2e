// The encodings of a tile (docs/spec.md, 3.4), for iogrid.h. Each function returns whether the
// bytes are a tile; if not, cells hold anything. Every loop ends with the cells or the bytes.
#ifndef IOGRID_TILES_H
#define IOGRID_TILES_H

#include <stddef.h>
#include <stdint.h>
#include <string.h>

#define IOGRID_CELLS 1024  // of a tile, 32 x 32, row by row

static inline uint32_t iogrid_be16(const uint8_t* at) { return (uint32_t)at[0] << 8 | at[1]; }
static inline uint32_t iogrid_be32(const uint8_t* at) {
  return iogrid_be16(at) << 16 | iogrid_be16(at + 2);
}
static inline uint64_t iogrid_be64(const uint8_t* at) {
  return (uint64_t)iogrid_be32(at) << 32 | iogrid_be32(at + 4);
}

typedef struct {
  const uint8_t* bytes;
  size_t bits, at;
  int failed;
} iogrid_bits;

static inline uint32_t iogrid_number(iogrid_bits* in, unsigned bits) {
  uint32_t value = 0;
  for (; bits > 0; --bits, ++in->at) {
    const uint32_t bit = in->at < in->bits ? in->bytes[in->at / 8] >> (7 - in->at % 8) & 1U : 0;
    in->failed |= in->at >= in->bits;
    value = value << 1 | bit;
  }
  return value;
}

static inline int iogrid_ends(iogrid_bits* in) {  // what is left are zeros, less than a byte
  return !in->failed && in->bits - in->at < 8 &&
         iogrid_number(in, (unsigned)(in->bits - in->at)) == 0;
}

static inline unsigned iogrid_width(uint64_t values) {  // bits that tell them apart
  unsigned bits = 0;
  for (; values > 1; values = (values + 1) / 2) ++bits;
  return bits;
}

typedef struct {  // digits to a base, many to a number of at most 31 bits
  iogrid_bits in;
  uint32_t base, left, fours, width, width_of_four, digits[32], count;
} iogrid_digits;

static inline uint32_t iogrid_digit(iogrid_digits* d) {
  if (d->base == 1) return 0;
  if (d->count == 0) {
    const uint32_t fours = d->left < d->fours ? d->left : d->fours;
    const uint32_t rest = fours * d->width_of_four;
    uint32_t value = iogrid_number(&d->in, fours == d->fours || rest > d->width ? d->width : rest);
    for (d->count = 0; d->count < 4 * fours; value /= d->base) {
      d->digits[d->count++] = value % d->base;  // the last one first
    }
    d->in.failed |= value != 0 || fours == 0;
    d->left -= fours;
  }
  return d->count ? d->digits[--d->count] : 0;
}

// Encodings 4 and, with a reference, 5.
static inline int iogrid_run_starts(const uint8_t* values, uint32_t count, const uint8_t* rest,
                                    size_t bytes, const uint8_t* reference, uint8_t* cells) {
  uint8_t is_start[IOGRID_CELLS] = {0};
  uint32_t starts = 0, symbol = 0;
  size_t at = 16;
  if (count > 215 || (count == 0 ? bytes != 0 : bytes < 16)) return 0;
  for (uint32_t block = 0; count > 0 && block < 128; ++block) {
    if ((rest[block / 8] >> block % 8 & 1) == 0) continue;
    if (at == bytes || rest[at] == 0) return 0;
    for (uint32_t i = 0; i < 8; ++i) {
      const uint32_t bit = rest[at] >> i & 1U;
      is_start[(block / 8 * 2 + i / 4) * 32 + block % 8 * 4 + i % 4] = (uint8_t)bit;
      starts += bit;
    }
    ++at;
  }
  iogrid_digits d = {{count ? rest + at : rest, count ? 8 * (bytes - at) : 0, 0, 0},
                     count,
                     (starts + 3) / 4,
                     0,
                     0,
                     0,
                     {0},
                     0};
  const uint64_t of_four = (uint64_t)count * count * count * count;
  uint64_t numbers = 1;
  for (; count > 1 && numbers * of_four <= 0x80000000U; ++d.fours) numbers *= of_four;
  d.width = iogrid_width(numbers);
  d.width_of_four = iogrid_width(of_four);
  for (uint32_t i = 0; i < IOGRID_CELLS; ++i) {
    if (is_start[i]) {
      const uint32_t digit = iogrid_digit(&d);
      symbol = digit + (digit >= symbol);
      if (d.in.failed || symbol > count) return 0;
    }
    cells[i] = symbol ? values[symbol - 1] : reference ? reference[i] : 0;
  }
  while (d.count > 0) {
    if (d.digits[--d.count] != 0) return 0;  // behind the last run
  }
  return iogrid_ends(&d.in);
}

// The frame that a tile of this frame refers to; its own number if it stands by itself.
static inline uint32_t iogrid_reference(uint32_t encoding, const uint8_t* payload, size_t bytes,
                                        uint32_t frame) {
  return encoding == 5 && bytes >= 1 ? frame - payload[0] : frame;
}

// reference: the tile of that frame.
static inline int iogrid_tile(uint32_t encoding, const uint8_t* payload, size_t bytes,
                              const uint8_t* reference, uint8_t* cells) {
  const size_t skipped = encoding == 5 ? 1 : 0;
  if (encoding == 0) {
    if (bytes != IOGRID_CELLS) return 0;
    memcpy(cells, payload, IOGRID_CELLS);
    return 1;
  }
  if (encoding != 4 && encoding != 5) return 0;
  if (bytes < skipped + 1 || bytes < skipped + 1 + payload[skipped]) return 0;
  const uint32_t count = payload[skipped];
  const uint8_t* values = payload + skipped + 1;
  const size_t left = bytes - skipped - 1 - count;
  if (memchr(values, 0x80, count) != NULL) return 0;  // no index, and no class
  return iogrid_run_starts(values, count, values + count, left, encoding == 5 ? reference : NULL,
                           cells);
}

#endif
