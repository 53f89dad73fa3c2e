// Consistent Overhead Byte Stuffing (Cheshire and Baker, IEEE/ACM Transactions on Networking 7,
// 1999): messages on a line that carries bytes and nothing else.
//
// On the line a message is blocks of a code byte c, 1 to 255, and c - 1 bytes that are not 0. Each
// block but the last stands for its bytes and a 0 behind them, one with c = 255 for its 254 bytes
// alone. A 0 ends the message: it occurs nowhere else, so a receiver that has lost its place finds
// it again at the next 0. An empty message is a code byte 1; two zeros in a row have nothing
// between them, which is no message and no error, so a sender may begin with a 0 to end what it
// knows nothing of.
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>

namespace iog::framing {

inline constexpr std::byte kDelimiter{0};
inline constexpr std::size_t kMaxBlockBytes = 254;

// Bytes on the line of a message of `bytes`, at most: a code for each 254 bytes begun, at least
// one, and the delimiter.
[[nodiscard]] constexpr std::size_t max_framed_bytes(std::size_t bytes) {
  return bytes + bytes / kMaxBlockBytes + 2;
}

// Writes the frame of the message, delimiter included. Returns its bytes, 0 if they do not fit;
// with max_framed_bytes() they do. The buffers must not overlap.
[[nodiscard]] std::size_t encode_cobs(std::span<const std::byte> message,
                                      std::span<std::byte> frame);

// Takes a line byte by byte and gives the messages in it. The buffer is the caller's and holds the
// message that was last completed until the next byte is taken.
class CobsDecoder {
 public:
  explicit constexpr CobsDecoder(std::span<std::byte> buffer) : buffer_{buffer} {}

  // The message that this byte completes.
  [[nodiscard]] std::optional<std::span<const std::byte>> take(std::byte byte);

  // What ended in the middle of a block, or was longer than the buffer.
  [[nodiscard]] std::uint32_t damaged() const { return damaged_; }

 private:
  [[nodiscard]] std::optional<std::span<const std::byte>> end_frame();
  void append(std::byte byte);

  std::span<std::byte> buffer_;
  std::size_t size_ = 0;
  std::size_t block_left_ = 0;  // bytes to come of this block
  bool zero_is_due_ = false;    // before the next block
  bool is_empty_ = true;        // no byte since the last delimiter
  bool is_too_long_ = false;
  std::uint32_t damaged_ = 0;
};

}  // namespace iog::framing
