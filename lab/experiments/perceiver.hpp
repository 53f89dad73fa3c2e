// A target with classes, without the target: datagrams in, and the newest frame's report and
// classes out.
#pragma once

#include <algorithm>
#include <array>
#include <cstdint>
#include <functional>
#include <memory>
#include <span>
#include <vector>

#include "app/frame.hpp"
#include "app/perception_engine.hpp"
#include "stream/class_end.hpp"
#include "tools/formats/capture/capture_clock.hpp"
#include "tools/formats/capture/datagram.hpp"
#include "vehicle/vehicle.hpp"
#include "window/window_view.hpp"

namespace iog::lab {

// A capture stands for what its replayer sends, whatever address the sensors had.
inline constexpr std::uint32_t kReplayer = 0x0A000202;

// The rows of the window's tiles, put together from the lowest y: copy_tile(slot, tile) copies a
// tile, or says that nothing is known in it.
template <typename CopyTile>
std::vector<std::int8_t> rows_of(const window::Area& area, const CopyTile& copy_tile) {
  std::vector<std::int8_t> rows(std::size_t{window::kCellsAcross} * window::kCellsAcross);
  std::array<std::int8_t, geometry::kTileCells> tile{};
  for (std::size_t slot = 0; slot < window::kSlotCount; ++slot) {
    if (!copy_tile(slot, tile)) {
      continue;
    }
    const window::TileNumber at = area.tile_at(slot);
    const auto row = static_cast<std::size_t>(at.b - area.corner().b) * window::kTileSide;
    const auto column = static_cast<std::size_t>(at.a - area.corner().a) * window::kTileSide;
    for (std::size_t y = 0; y < window::kTileSide; ++y) {
      std::copy_n(&tile[y * window::kTileSide], window::kTileSide,
                  &rows[(row + y) * window::kCellsAcross + column]);
    }
  }
  return rows;
}

class Perceiver {
 public:
  using OnFrame = std::function<void(const Perceiver&)>;

  // The map is a block, or empty; vehicle and map outlive it. on_frame is called for each frame
  // when it is over.
  Perceiver(const vehicle::Vehicle& vehicle, std::span<const std::uint8_t> map,
            OnFrame on_frame = {});
  Perceiver(const Perceiver&) = delete;
  Perceiver& operator=(const Perceiver&) = delete;

  void take(const tools::CapturedDatagram& datagram);

  [[nodiscard]] std::uint32_t frames() const { return frames_; }
  // Whether the datagram that was taken last, or is being taken, is in a frame already.
  [[nodiscard]] bool has_fused_newest() const { return has_fused_newest_; }
  // Of the newest frame.
  [[nodiscard]] const app::PerceptionEngine& engine() const { return *engine_; }
  [[nodiscard]] const stream::ClassEnd& end() const { return end_; }
  [[nodiscard]] const objects::Tracker& objects() const { return engine_->objects(); }
  [[nodiscard]] const window::Area& area() const { return engine_->classes().area(); }
  [[nodiscard]] std::vector<std::int8_t> classes() const;

 private:
  void close_frame(std::uint64_t now_us);

  OnFrame on_frame_;
  tools::CaptureClock clock_;
  // Too large for the stack.
  std::unique_ptr<app::Frame> frame_;
  std::unique_ptr<app::PerceptionEngine> engine_;
  stream::ClassEnd end_;
  std::uint32_t frames_ = 0;
  bool has_fused_newest_ = false;
};

}  // namespace iog::lab
