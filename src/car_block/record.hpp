// Reads and writes the records of the car block. A record consists of a header (magic number,
// version, length and CRC) and the content (docs/spec.md, section 8.1).
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>

#include "car_block/layout.hpp"

namespace iog::car_block {

// The reason for rejecting a car. The values are listed in docs/spec.md, section 8.5.
enum class Refusal : std::uint8_t {
  kNone,
  kNoRecord,      // wrong magic number
  kWrongVersion,  // unsupported version of the format
  kWrongLength,   // longer than the space for the record
  kDamaged,       // wrong CRC, or a reserved byte that is not zero
  kNotACar,       // the bytes do not describe a car
  kOtherGrid,     // the tables were made for a different cell size or grid size
  kOtherGrids,    // the car needs grids that this firmware does not produce
  kLimit,         // a field exceeds its limit
};
inline constexpr std::size_t kRefusalCount = 9;

struct Record {
  Refusal refusal = Refusal::kNone;
  std::span<const std::byte> content{};  // empty unless the record is valid
  std::uint32_t crc = 0;                 // CRC of the content
};

[[nodiscard]] Record read_record(Block block, const RecordPlace& place);

// Adds the header to content that is already in place. `bytes` is the length of the content. The
// content must fit into the record.
void frame_record(WritableBlock block, const RecordPlace& place, std::size_t bytes);

}  // namespace iog::car_block
