// The type of a device register specifies the permitted accesses.
//
//   Ro  read only                       Rw  read and write
//   Wo  write only                      W1c event flags: writing a one clears
//
// W1c deliberately has no read-modify-write access, because `flags |= bit` would clear every set
// flag. The registers of a peripheral form a struct that the linker places
// (linker/<board>_peripherals.ld).
#pragma once

#include <cstdint>

#include "machine.hpp"

namespace iog::board {

template <typename Word>
class Ro {
 public:
  Word read() const { return machine::load(word_); }

 private:
  Word word_;
};

template <typename Word>
class Wo {
 public:
  void write(Word value) { machine::store(word_, value); }

 private:
  Word word_;
};

template <typename Word>
class Rw {
 public:
  Word read() const { return machine::load(word_); }
  void write(Word value) { machine::store(word_, value); }
  void set_bits(Word bits) { write(static_cast<Word>(read() | bits)); }
  void clear_bits(Word bits) { write(static_cast<Word>(read() & ~bits)); }

 private:
  Word word_;
};

template <typename Word>
class W1c {
 public:
  Word read() const { return machine::load(word_); }
  void clear(Word flags) { machine::store(word_, flags); }

 private:
  Word word_;
};

using Ro32 = Ro<std::uint32_t>;
using Wo32 = Wo<std::uint32_t>;
using Rw32 = Rw<std::uint32_t>;
using W1c32 = W1c<std::uint32_t>;
using Rw16 = Rw<std::uint16_t>;
using Ro16 = Ro<std::uint16_t>;

// The space between two registers. A gap is named after the offset at which it begins.
template <unsigned kFrom, unsigned kTo>
using Gap = std::uint8_t[kTo - kFrom];

}  // namespace iog::board
