// The header of class tile messages, which describes the world-aligned window (docs/spec.md 3.9).
// The header contains the window's position, the last pose of the vehicle, and the reasons why
// slices were not placed.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>

#include "pose/message.hpp"
#include "tile_coding/tile_cells.hpp"
#include "window/area.hpp"
#include "wire/byte_reader.hpp"

namespace iog::stream {

// The bits of ClassWindow::causes. Each bit reports an event that occurred since the previous
// frame. The values of the bits are part of the wire format. A break resets all cells of the window
// to unknown.
inline constexpr std::uint16_t kCauseLate = 0x0001;          // no pose within 100 ms of a slice
inline constexpr std::uint16_t kCauseLost = 0x0002;          // no pose for 1 s; break
inline constexpr std::uint16_t kCauseImprecise = 0x0004;     // pose too imprecise
inline constexpr std::uint16_t kCauseJump = 0x0008;          // pose far from prediction; break
inline constexpr std::uint16_t kCauseRestart = 0x0010;       // pose source restarted; break
inline constexpr std::uint16_t kCauseOverBudget = 0x0020;    // cells deferred to later frames
inline constexpr std::uint16_t kCauseContradicted = 0x0040;  // contradicted by sensors; break
inline constexpr std::uint16_t kCauseDrifting = 0x0080;      // poses arrive later and later; break

struct ClassWindow {
  std::uint16_t causes = 0;
  // The coordinates of the tile with the lowest x and y. In the local frame, tile (a, b) begins at
  // `x = a * s` and `y = b * s`, where s is the side length of a tile.
  std::int32_t corner_a = 0;
  std::int32_t corner_b = 0;
  pose::Pose pose{};          // pose at the end of the last slice; zero if unknown
  pose::Sigma sigma{};        // standard deviations of the last second's motion; maximum if unknown
  std::uint8_t slices = 0;    // number of slices placed in this frame
  std::uint8_t slice_ms = 0;  // duration of a slice
  std::uint64_t slices_begin_us = 0;  // start of the first slice, by the pose source's clock
  std::uint64_t slices_end_us = 0;    // end of the last slice, which is the timestamp of the frame

  // Returns true if at least one slice was placed and `pose` is known.
  [[nodiscard]] constexpr bool has_place() const { return slices > 0 && sigma != pose::Sigma{}; }
  friend constexpr bool operator==(const ClassWindow&, const ClassWindow&) = default;
};
inline constexpr std::size_t kClassWindowBytes = 48;

// Returns the area of the window.
[[nodiscard]] constexpr window::Area area_of(const ClassWindow& classes,
                                             window::Extent extent = {}) {
  return window::Area({.a = classes.corner_a, .b = classes.corner_b}, extent);
}

// A cell of a class tile contains a class and a confidence (docs/spec.md 3.9). A cell with the
// value 0 is unknown and has a confidence of 0.
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

// Returns true if every cell of a decoded tile contains a valid class byte.
[[nodiscard]] bool are_class_bytes(tile_coding::TileCells cells);

void write_class_window(const ClassWindow& window, std::span<std::byte, kClassWindowBytes> buffer);

// Reads the header and skips fields that a later version may append. Returns false if the header is
// too short.
[[nodiscard]] bool read_class_window(wire::ByteReader& in, ClassWindow& window);

}  // namespace iog::stream
