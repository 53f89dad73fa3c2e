// Defines the outcomes of datagrams on the map port. The values are defined in docs/spec.md,
// section 7.2.
#pragma once

#include <cstddef>
#include <cstdint>

namespace iog::map {

// The outcome of a datagram. If the outcome is not kTaken, the datagram is dropped and has no
// effect.
enum class Fate : std::uint8_t {
  kTaken,         // its bytes were stored
  kRepeated,      // its bytes were already stored
  kInUse,         // belongs to the block in use
  kOtherBlock,    // a different block is being delivered
  kStranger,      // it does not come from the configured sender
  kTooShort,      // shorter than a message without bytes of a block
  kNotOurs,       // wrong SOME/IP service, event or message type
  kWrongVersion,  // of the interface or of the content
  kDamaged,       // wrong CRC, data id, or length covered by the CRC
  kWrongLength,   // the content, or the block bytes in it, do not have the stated length
  kNotZero,       // a field that must be zero is not
  kOutOfRange,    // no block has this length, or no chunk starts there
};
inline constexpr std::size_t kFateCount = 12;

}  // namespace iog::map
