// The four functions that a compiler calls on its own, also in freestanding code (GCC manual,
// "Language Standards Supported by GCC"). This file is built without loop-distribution patterns, or
// the compiler would recognise memcpy() in the body of memcpy() and call it.
//
// Copies go 16 bytes at a time through a NEON register. The element size of these loads and stores
// is one byte, so no address is ever unaligned, on uncached memory neither.
#include <cstddef>
#include <cstdint>

namespace {

using Block = std::uint8_t __attribute__((vector_size(16), aligned(1), may_alias));
constexpr std::size_t kBlock = sizeof(Block);

Block load(const unsigned char* from) {
  return *reinterpret_cast<const Block*>(from);
}
void store(unsigned char* to, const Block& block) {
  *reinterpret_cast<Block*>(to) = block;
}

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
    const Block first = load(from);
    const Block second = load(from + kBlock);
    const Block third = load(from + 2 * kBlock);
    const Block fourth = load(from + 3 * kBlock);
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
  const Block block = Block{} + byte;
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
