// The four functions that a compiler calls on its own, also in freestanding code (GCC manual,
// "Language Standards Supported by GCC"). This file is built without loop-distribution patterns, or
// the compiler would recognise memcpy() in the body of memcpy() and call it.
//
// Copies go 16 bytes at a time through a NEON register. The element size of these loads and stores
// is one byte, so no address is ever unaligned, on uncached memory neither.
#include <arm_neon.h>
#include <cstddef>
#include <cstdint>

namespace {

constexpr std::size_t kBlock = 16;

uint8x16_t load(const unsigned char* from) { return vld1q_u8(from); }
void store(unsigned char* to, uint8x16_t block) { vst1q_u8(to, block); }

}  // namespace

extern "C" {

void* memcpy(void* __restrict destination, const void* __restrict source, std::size_t bytes);
void* memmove(void* destination, const void* source, std::size_t bytes);
void* memset(void* destination, int value, std::size_t bytes);
int memcmp(const void* left, const void* right, std::size_t bytes);
std::size_t strlen(const char* text);

void* memcpy(void* __restrict destination, const void* __restrict source, std::size_t bytes) {
  auto* to = static_cast<unsigned char*>(destination);
  const auto* from = static_cast<const unsigned char*>(source);
  for (; bytes >= 4 * kBlock; bytes -= 4 * kBlock, to += 4 * kBlock, from += 4 * kBlock) {
    const uint8x16_t first = load(from);
    const uint8x16_t second = load(from + kBlock);
    const uint8x16_t third = load(from + 2 * kBlock);
    const uint8x16_t fourth = load(from + 3 * kBlock);
    store(to, first);
    store(to + kBlock, second);
    store(to + 2 * kBlock, third);
    store(to + 3 * kBlock, fourth);
  }
  for (; bytes >= kBlock; bytes -= kBlock, to += kBlock, from += kBlock) {
    store(to, load(from));
  }
  for (; bytes != 0; --bytes) {
    *to++ = *from++;
  }
  return destination;
}

void* memmove(void* destination, const void* source, std::size_t bytes) {
  auto* to = static_cast<unsigned char*>(destination);
  const auto* from = static_cast<const unsigned char*>(source);
  // Upwards is right unless the destination begins inside the source. Each block is read whole
  // before it is written, so overlap within a block does no harm in either direction.
  if (reinterpret_cast<std::uintptr_t>(to) - reinterpret_cast<std::uintptr_t>(from) >= bytes) {
    for (; bytes >= kBlock; bytes -= kBlock, to += kBlock, from += kBlock) {
      store(to, load(from));
    }
    for (; bytes != 0; --bytes) {
      *to++ = *from++;
    }
    return destination;
  }
  for (; bytes >= kBlock; bytes -= kBlock) {
    store(to + bytes - kBlock, load(from + bytes - kBlock));
  }
  for (; bytes != 0; --bytes) {
    to[bytes - 1] = from[bytes - 1];
  }
  return destination;
}

void* memset(void* destination, int value, std::size_t bytes) {
  auto* to = static_cast<unsigned char*>(destination);
  const auto byte = static_cast<unsigned char>(value);
  const uint8x16_t block = vdupq_n_u8(byte);
  for (; bytes >= kBlock; bytes -= kBlock, to += kBlock) {
    store(to, block);
  }
  for (; bytes != 0; --bytes) {
    *to++ = byte;
  }
  return destination;
}

int memcmp(const void* left, const void* right, std::size_t bytes) {
  const auto* a = static_cast<const unsigned char*>(left);
  const auto* b = static_cast<const unsigned char*>(right);
  for (; bytes != 0; --bytes, ++a, ++b) {
    if (*a != *b) {
      return *a < *b ? -1 : 1;
    }
  }
  return 0;
}

std::size_t strlen(const char* text) {
  std::size_t length = 0;
  while (text[length] != '\0') {
    ++length;
  }
  return length;
}

}  // extern "C"
