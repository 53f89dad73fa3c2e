// Pose messages written byte by byte from their description (docs/spec.md, sections 3.1 and 5.1),
// without any code of the encoder's.
#pragma once

#include <cstddef>
#include <cstdint>

#include "fakes/message_bytes.hpp"

namespace iog::tests {

class PoseBytes : public MessageBytes<PoseBytes> {
 public:
  // The first message of a sender: run 7, measured at 3 s, everything else as small as it may be.
  PoseBytes() : MessageBytes(100, 0x8003, 0x494F4703) {
    put(28, 1, 1);   // version of the content
    put(30, 2, 72);  // its bytes
    put(32, 4, 7);
    put(40, 8, 3'000'000);
    put(60, 2, 1);
    put(62, 2, 1);
    seal();
  }

  // As many bytes, the new ones zero, and every length that says so.
  PoseBytes& resize(std::size_t bytes) {
    return MessageBytes::resize(bytes).put(30, 2, static_cast<std::int64_t>(bytes) - 28);
  }
};

}  // namespace iog::tests
