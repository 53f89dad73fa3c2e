// What becomes of a datagram on the maps' port. The values are those of docs/spec.md, section 7.2.
#pragma once

#include <cstddef>
#include <cstdint>

namespace iog::map {

// Each datagram has one of these fates. All but the first are drops: they change nothing.
enum class Fate : std::uint8_t {
  kTaken,         // its bytes are in place
  kRepeated,      // its bytes were in place before
  kInUse,         // of the block that is in use
  kOtherBlock,    // another block is being delivered
  kStranger,      // not from the sender that the description names
  kTooShort,      // shorter than a message without bytes of a block
  kNotOurs,       // another SOME/IP, service, event or message type
  kWrongVersion,  // of the interface, or of the content
  kDamaged,       // wrong CRC, data id or length of what the CRC covers
  kWrongLength,   // the content, or its piece of the block, is not as long as it says
  kNotZero,       // something that has to be zero is not
  kOutOfRange,    // no block is so long, or none of its chunks begins there
};
inline constexpr std::size_t kFateCount = 12;

}  // namespace iog::map
