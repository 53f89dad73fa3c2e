// Reads the recorder of fakes/machine.hpp: what a driver stored in one register block, in order.
#pragma once

#include <cstddef>
#include <cstdint>
#include <ostream>
#include <vector>

#include "machine.hpp"

namespace iog::machine {

// An offset in the block, as the manual counts, and what was stored there.
struct Write {
  std::size_t offset = 0;
  std::uint32_t value = 0;

  friend bool operator==(const Write&, const Write&) = default;
  friend std::ostream& operator<<(std::ostream& out, const Write& write) {
    return out << std::hex << "[" << write.offset << "] = " << write.value << std::dec;
  }
};

template <typename Block>
std::vector<Write> writes_to(const Block& block) {
  const auto* begin = reinterpret_cast<const std::byte*>(&block);
  std::vector<Write> writes;
  for (const Event& event : recorder.events) {
    const auto* address = static_cast<const std::byte*>(event.address);
    if (event.kind == Event::Kind::kStore && address >= begin && address < begin + sizeof(Block)) {
      writes.push_back({static_cast<std::size_t>(address - begin), event.value});
    }
  }
  return writes;
}

// The last value stored at an offset; 0 if there was none.
template <typename Block>
std::uint32_t last_write(const Block& block, std::size_t offset) {
  std::uint32_t value = 0;
  for (const Write& write : writes_to(block)) {
    value = write.offset == offset ? write.value : value;
  }
  return value;
}

}  // namespace iog::machine
