// The message that a target sends if it rejects the car block in its firmware image. A target
// without a valid car block sends no grid (docs/spec.md 3.11).
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <string_view>

namespace iog::stream {

inline constexpr std::size_t kMaxRefusalWords = 255;

struct CarRefusal {
  std::uint8_t reason = 0;  // car_block::Refusal
  std::string_view words;   // ASCII, truncated to kMaxRefusalWords
};

// Returns the number of bytes written, or 0 if the buffer is too small.
std::size_t write_car_refusal(const CarRefusal& refusal, std::span<std::byte> buffer);

// Returns std::nullopt if the body is too short. `words` is a view of the body.
[[nodiscard]] std::optional<CarRefusal> read_car_refusal(std::span<const std::byte> body);

}  // namespace iog::stream
