#include "framing/cobs.hpp"

#include <algorithm>

namespace iog::framing {

// A block of 254 bytes implies no zero after it. The message itself does not end with a zero
// either, so a frame of 254 bytes ends with that block and needs no empty one.
std::size_t encode_cobs(std::span<const std::byte> message, std::span<std::byte> frame) {
  std::size_t out = 0;
  bool is_last = false;
  while (!is_last) {
    const auto window = message.first(std::min(message.size(), kMaxBlockBytes));
    const auto zero = std::ranges::find(window, kDelimiter);
    const auto length = static_cast<std::size_t>(zero - window.begin());
    const bool has_zero = length < window.size();
    is_last = !has_zero && length == message.size();
    if (frame.size() - out < length + 2) {  // code, block, and the delimiter or next code
      return 0;
    }
    frame[out] = static_cast<std::byte>(length + 1);
    std::ranges::copy(window.first(length), frame.subspan(out + 1).begin());
    out += length + 1;
    message = message.subspan(length + (has_zero ? 1 : 0));
  }
  frame[out] = kDelimiter;
  return out + 1;
}

std::optional<std::span<const std::byte>> CobsDecoder::decode(std::byte byte) {
  if (byte == kDelimiter) {
    return end_frame();
  }
  if (is_empty_) {
    size_ = 0;
    is_empty_ = false;
  }
  if (block_left_ > 0) {
    append(byte);
    --block_left_;
    return std::nullopt;
  }
  if (zero_is_due_) {
    append(kDelimiter);
  }
  block_left_ = std::to_integer<std::size_t>(byte) - 1;
  zero_is_due_ = block_left_ < kMaxBlockBytes;
  return std::nullopt;
}

std::optional<std::span<const std::byte>> CobsDecoder::end_frame() {
  const bool is_message = !is_empty_ && block_left_ == 0 && !is_too_long_;
  damaged_ += !is_empty_ && !is_message ? 1U : 0U;
  block_left_ = 0;
  zero_is_due_ = false;
  is_empty_ = true;
  is_too_long_ = false;
  if (!is_message) {
    return std::nullopt;
  }
  return buffer_.first(size_);
}

void CobsDecoder::append(std::byte byte) {
  if (size_ == buffer_.size()) {
    is_too_long_ = true;
    return;
  }
  buffer_[size_++] = byte;
}

}  // namespace iog::framing
