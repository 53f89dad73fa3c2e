// A record of the car block (docs/spec.md, section 8.1): framed by what it is, how long, and a CRC.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>

#include "car_block/layout.hpp"

namespace iog::car_block {

// Why a car is not taken. The values are those of docs/spec.md, section 8.5.
enum class Refusal : std::uint8_t {
  kNone,
  kNoRecord,      // another magic number
  kWrongVersion,  // of a later or an earlier form
  kWrongLength,   // longer than its place
  kDamaged,       // wrong CRC, or something that has to be zero is not
  kNotACar,       // bytes that are no description
  kOtherGrid,     // tables of another size of cells or grid
  kOtherGrids,    // the car asks for grids that this firmware has not
  kLimit,         // a field is beyond its limit
};
inline constexpr std::size_t kRefusalCount = 9;

struct Record {
  Refusal refusal = Refusal::kNone;
  std::span<const std::byte> content{};  // of a sound one
  std::uint32_t crc = 0;                 // of its content
};

[[nodiscard]] Record read_record(Block block, const RecordPlace& place);

// Frames the content that already stands behind the header. bytes: at most what the place holds.
void frame_record(WritableBlock block, const RecordPlace& place, std::size_t bytes);

}  // namespace iog::car_block
