// The header of the world-aligned window in messages of class tiles (docs/spec.md 3.9): where the
// window is, from where it was last seen, and what kept the frame from being placed.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>

#include "pose/message.hpp"
#include "tile_coding/tile_cells.hpp"
#include "window/area.hpp"
#include "wire/byte_reader.hpp"

namespace iog::stream {

// Bits of ClassWindow::causes: what happened since the frame before. The values are on the wire.
inline constexpr std::uint16_t kCauseLate = 0x0001;          // no pose within 100 ms of a slice
inline constexpr std::uint16_t kCauseLost = 0x0002;          // none for 1 s: the window is unknown
inline constexpr std::uint16_t kCauseImprecise = 0x0004;     // the pose's deviation is too large
inline constexpr std::uint16_t kCauseJump = 0x0008;          // against its prediction: unknown
inline constexpr std::uint16_t kCauseRestart = 0x0010;       // of the pose source: unknown
inline constexpr std::uint16_t kCauseOverBudget = 0x0020;    // cells were left to the next frames
inline constexpr std::uint16_t kCauseContradicted = 0x0040;  // by the sensors: unknown
inline constexpr std::uint16_t kCauseDrifting = 0x0080;      // poses come ever later: unknown

struct ClassWindow {
  std::uint16_t causes = 0;
  // Tile of lowest x and y: tile (a, b) begins at a and b times a tile's side in the local frame.
  std::int32_t corner_a = 0;
  std::int32_t corner_b = 0;
  pose::Pose pose{};                  // when the last slice ended, zero if it is not known
  pose::Sigma sigma{};                // of the motion in the second before, the largest likewise
  std::uint8_t slices = 0;            // of this frame that were placed
  std::uint8_t slice_ms = 0;          // how long each is
  std::uint64_t slices_begin_us = 0;  // of the first, by the clock of the pose source
  std::uint64_t slices_end_us = 0;    // of the last: the stamp of the frame

  // Whether something was placed, and the pose behind it is known.
  [[nodiscard]] constexpr bool has_place() const { return slices > 0 && sigma != pose::Sigma{}; }
  friend constexpr bool operator==(const ClassWindow&, const ClassWindow&) = default;
};
inline constexpr std::size_t kClassWindowBytes = 48;

// The tiles that it has. Their numbers in messages are their slots, which they keep while the
// window moves.
[[nodiscard]] constexpr window::Area area_of(const ClassWindow& classes) {
  return window::Area({.a = classes.corner_a, .b = classes.corner_b});
}

// A cell of a class tile: its class, and how sure that is. 0 is unknown, and nothing is surer of
// that. Classes are numbered in docs/spec.md 3.9.
inline constexpr std::uint8_t kClassCount = 9;
inline constexpr std::uint8_t kSurenessCount = 8;

[[nodiscard]] constexpr bool is_class_byte(std::byte cell) {
  return cell == std::byte{0} ||
         (cell >= std::byte{kSurenessCount} && cell < std::byte{kClassCount * kSurenessCount});
}
[[nodiscard]] constexpr std::uint8_t class_of(std::byte cell) {
  return static_cast<std::uint8_t>(std::to_integer<unsigned>(cell) / kSurenessCount);
}
[[nodiscard]] constexpr std::uint8_t sureness_of(std::byte cell) {
  return static_cast<std::uint8_t>(std::to_integer<unsigned>(cell) % kSurenessCount);
}

// Whether a tile that was decoded can be one of classes.
[[nodiscard]] bool are_class_bytes(tile_coding::TileCells cells);

void write_class_window(const ClassWindow& window, std::span<std::byte, kClassWindowBytes> buffer);

// Reads it and skips what a later version has behind it. False if it is too short, or says so.
[[nodiscard]] bool read_class_window(wire::ByteReader& in, ClassWindow& window);

}  // namespace iog::stream
