// Consistent Overhead Byte Stuffing (Cheshire and Baker, IEEE/ACM Transactions on Networking 7,
// 1999) separates messages on a serial link that transports only bytes.
//
// A framed message is a sequence of blocks. A block is a code byte c, 1 to 255, followed by c - 1
// bytes that are not 0. A block represents its bytes followed by a 0. The last block, and any block
// with c = 255, represents its bytes without the 0. The byte 0 ends the message.
//
// The byte 0 occurs nowhere else, so a receiver that has lost synchronisation resynchronises at the
// next 0. An empty message is encoded as the code byte 1. Two adjacent zeros are neither a message
// nor an error. A sender may therefore begin with a 0 to end any bytes sent before.
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>

namespace iog::framing {

inline constexpr std::byte kDelimiter{0};
inline constexpr std::size_t kMaxBlockBytes = 254;

// The maximum length of a framed message of `bytes` bytes. It consists of the message, one code
// byte for each started group of 254 bytes, at least one, and the delimiter.
[[nodiscard]] constexpr std::size_t max_framed_bytes(std::size_t bytes) {
  return bytes + bytes / kMaxBlockBytes + 2;
}

// Frames the message, including the delimiter. Returns the length of the frame, or 0 if the frame
// does not fit. A buffer of max_framed_bytes() is always large enough. The buffers must not
// overlap.
[[nodiscard]] std::size_t encode_cobs(std::span<const std::byte> message,
                                      std::span<std::byte> frame);

// Decodes messages from the bytes of a link, one byte at a time. The caller owns the buffer. It
// contains the last complete message until the next byte is decoded.
class CobsDecoder {
 public:
  explicit constexpr CobsDecoder(std::span<std::byte> buffer) : buffer_{buffer} {}

  // Returns the message that this byte completes, if any.
  [[nodiscard]] std::optional<std::span<const std::byte>> decode(std::byte byte);

  // The number of frames that ended within a block or were longer than the buffer.
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
