// What every fuzz target needs: a law, and what calls it.
#pragma once

#include <cstddef>
#include <cstdint>
#include <cstdio>
#include <cstdlib>
#include <span>

#include "wire/byte_reader.hpp"

namespace iog::fuzz {

// Ends the run if the law does not hold for this input; libFuzzer keeps the input.
inline void law(bool holds, const char* text) {
  if (!holds) {
    std::fprintf(stderr, "broken law: %s\n", text);
    std::abort();
  }
}

// The next piece of an input that is a series of pieces: u16 length, big endian, and that many
// bytes, or what is left of them.
inline std::span<const std::byte> next_piece(wire::ByteReader& in) {
  const std::size_t length = in.u16_be();
  return in.bytes(length < in.remaining() ? length : in.remaining());
}

// Each target's own: what is to hold for an input.
void check(std::span<const std::byte> input);

}  // namespace iog::fuzz

// What libFuzzer calls with each input; it wants 0.
// NOLINTNEXTLINE(readability-identifier-naming): libFuzzer gives the name.
extern "C" [[gnu::used]] inline int LLVMFuzzerTestOneInput(const std::uint8_t* data,
                                                           std::size_t size) {
  iog::fuzz::check(std::as_bytes(std::span(data, size)));
  return 0;
}
