// Consistent Overhead Byte Stuffing (Cheshire and Baker, IEEE/ACM Transactions on Networking 7,
// 1999). The framing separates messages on a serial link that transports only bytes.
//
// A framed message is a sequence of blocks. A block consists of a code byte c from 1 to 255,
// followed by c - 1 bytes that are not 0. Normally, a block represents its c - 1 bytes followed by
// a 0. If c is 255, or if the block is the last one in the message, the block represents only its
// c - 1 bytes. A zero byte ends the message.
//
// Zero bytes occur only at the end of messages, so a receiver that loses synchronisation
// resynchronises at the next 0. An empty message is encoded as the code byte 1. A receiver ignores
// the second of two adjacent zeros. A sender may therefore start with a 0 to separate its message
// from earlier bytes.
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>

namespace iog::framing {

inline constexpr std::byte kDelimiter{0};
inline constexpr std::size_t kMaxBlockBytes = 254;

// Returns the maximum length of the frame for a message of `bytes` bytes. The frame consists of the
// message, at least one code byte, and the delimiter. Each group of 254 bytes, full or partial,
// requires one code byte.
[[nodiscard]] constexpr std::size_t max_framed_bytes(std::size_t bytes) {
  return bytes + bytes / kMaxBlockBytes + 2;
}

// Frames the message and appends the delimiter. Returns the length of the frame, or 0 if `frame` is
// too small. A buffer of max_framed_bytes() bytes is always large enough. The buffers must not
// overlap.
[[nodiscard]] std::size_t encode_cobs(std::span<const std::byte> message,
                                      std::span<std::byte> frame);

// Decodes messages from the bytes of a link, one byte at a time. The caller owns the buffer, which
// contains the last complete message until the next byte is decoded.
class CobsDecoder {
 public:
  explicit constexpr CobsDecoder(std::span<std::byte> buffer) : buffer_{buffer} {}

  // Returns the message that `byte` completes, or std::nullopt if no message is complete.
  [[nodiscard]] std::optional<std::span<const std::byte>> decode(std::byte byte);

  // The number of frames that ended within a block or did not fit in the buffer.
  [[nodiscard]] std::uint32_t damaged() const { return damaged_; }

 private:
  [[nodiscard]] std::optional<std::span<const std::byte>> end_frame();
  void append(std::byte byte);

  std::span<std::byte> buffer_;
  std::size_t size_ = 0;
  std::size_t block_left_ = 0;  // bytes left in the current block
  bool zero_is_due_ = false;    // a zero must be inserted before the next block
  bool is_empty_ = true;        // no byte received since the last delimiter
  bool is_too_long_ = false;
  std::uint32_t damaged_ = 0;
};

}  // namespace iog::framing
