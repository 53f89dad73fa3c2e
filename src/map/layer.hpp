// The map layer of the window. The layer schedules the drawing of tiles: it determines which tiles
// are drawn, which are pending, and which must be drawn again.
//
// A tile becomes pending when it enters the window or when the map changes. A drawn tile becomes
// pending again if, since it was drawn, the blur has become wider or the transform has moved any
// corner of the tile by more than a cell. If the blur becomes narrower, the tile is not drawn
// again, because its mask is still correct, although less specific than it could be. The cells of a
// pending tile may have any class. The tile that has been pending longest is drawn first. Among
// tiles that became pending in the same frame, the tile with the lowest slot is drawn first.
//
// If the sensors contradict the map (map/agreement.hpp), the map does not rule out any classes. The
// layer still draws the map so that it can detect when the map agrees with the sensors again.
//
// Each frame has a limited budget for this work (kWorkPerFrame). When the budget is used up, the
// remaining work is postponed to the next frame, even in the middle of a tile. A tile takes effect
// only when its drawing is complete.
#pragma once

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>

#include "map/agreement.hpp"
#include "map/block.hpp"
#include "map/layer_report.hpp"
#include "map/slot_set.hpp"
#include "map/tile_drawing.hpp"
#include "perception/window_fusion.hpp"
#include "pose/message.hpp"
#include "window/area.hpp"

namespace iog::map {

// One unit of work is the examination of one edge. An edge that crosses a row of the tile's frame
// costs kWorkPerCrossing units, and each entry in the block's index costs 1 unit. A tile also costs
// kWorkPerTile units, or kWorkPerTileOutside units if it is outside the map's extent.
inline constexpr std::uint32_t kWorkPerFrame = 8'192;
inline constexpr std::uint32_t kWorkPerTile = 256;
inline constexpr std::uint32_t kWorkPerTileOutside = 32;

// Returns the radius of the blur in cells, rounded up. The radius is the sum of three lengths: the
// map's accuracy, two standard deviations of the transform's error at a distance of 50 m, and the
// diagonal of a cell. The result is at most 2^18.
[[nodiscard]] constexpr std::uint32_t blur_radius(std::uint32_t accuracy_mm,
                                                  const pose::Sigma& sigma,
                                                  std::uint32_t cell_mm = geometry::kCellMm) {
  // At a distance of 50 m, twice 10 urad corresponds to 1 mm.
  const std::uint32_t mm =
      accuracy_mm + 2U * sigma.position_mm + sigma.heading_10urad + cell_mm * 14 / 10;
  return (mm + cell_mm - 1) / cell_mm;
}

class Layer {
 public:
  Layer() = default;
  Layer(const Layer&) = delete;
  Layer& operator=(const Layer&) = delete;

  // Call this function once per frame, after the window has followed the vehicle. `block` is the
  // block in use, or null. The bytes of the block must stay valid until the next call. `transform`
  // is the transform of the newest pose, or std::nullopt if that pose has no transform.
  void work(const Block* block, const std::optional<pose::MapTransform>& transform,
            perception::WindowFusion& window);

  // Call this function instead of work() if there is no frame for the window. The function updates
  // only the report, so a gap in the data does not affect the drawing of tiles.
  void look(const Block* block, const std::optional<pose::MapTransform>& transform,
            const perception::WindowFusion& window);

  // Returns the report of the last frame.
  [[nodiscard]] const LayerReport& report() const { return report_; }

 private:
  enum class State : std::uint8_t {
    kIdle,     // a cause prevents drawing, there has never been a map, or it is outside the window
    kWaiting,  // to be drawn
    kDrawn,
    kOutside,
  };

  // The inputs from which a tile is drawn.
  struct Basis {
    pose::Pose local_frame{};
    std::uint8_t radius = 0;
    friend bool operator==(const Basis&, const Basis&) = default;
  };

  struct Unfinished {
    Unfinished(std::size_t of_slot, const Basis& by, const Block& block, const TilePlace& place)
        : slot(of_slot), basis(by), drawing(block, place, by.radius) {}

    std::size_t slot;
    Basis basis;
    TileDrawing drawing;
  };

  void take_inputs(const Block* block, const std::optional<pose::MapTransform>& transform,
                   const perception::WindowFusion& window);
  void report_cause(Cause cause);
  [[nodiscard]] Cause cause_of(const Block* block, bool is_centred) const;
  void begin(Cause cause);
  void find_stale(const Block& block, perception::WindowFusion& window);
  void drop_stale_drawing(const window::Area& area, bool is_of_other_bytes);
  [[nodiscard]] bool is_stale(const Basis& basis, window::TileNumber tile) const;
  [[nodiscard]] bool is_done(std::size_t slot) const {
    return states_[slot] == State::kDrawn || states_[slot] == State::kOutside;
  }
  void withdraw(std::size_t slot, State next, perception::WindowFusion& window);
  void withdraw_all(perception::WindowFusion& window);
  void draw_waiting(const Block& block, perception::WindowFusion& window);
  [[nodiscard]] std::uint32_t oldest() const;
  void draw(const Block& block, std::size_t slot, perception::WindowFusion& window);
  void judge(perception::WindowFusion& window);
  void finish(std::size_t slot, State state, const Basis& basis);
  void set_state(std::size_t slot, State state);
  void spend(std::uint32_t work) { budget_ -= std::min(budget_, work); }

  // Each of these members is a separate array, indexed by slot, so that a scan over all states does
  // not read other data.
  std::array<State, window::kSlotCount> states_{};
  std::array<std::uint32_t, window::kSlotCount> since_{};  // frame in which a tile began to wait
  std::array<Basis, window::kSlotCount> bases_{};          // of drawn or outside tiles
  std::array<window::Plane, window::kSlotCount> inside_buildings_{};  // of drawn tiles
  Agreement agreement_;
  SlotSet waiting_;
  std::array<std::uint16_t, 4> counts_{window::kSlotCount};  // slots by state
  std::optional<Unfinished> unfinished_;
  window::TileRuledOut ruled_out_{};
  LayerReport report_;
  std::uint32_t frame_ = 0;
  std::int32_t cell_mm_ = geometry::kCellMm;
  std::size_t tiles_ = window::kSlotCount;  // of the window
  std::uint32_t budget_ = 0;                // remaining work of this frame
  Basis now_{};
  // The following members describe the last frame in which tiles could be drawn.
  Basis basis_{};
  window::Area area_;
  std::uint32_t crc_ = 0;
  const std::byte* data_ = nullptr;
  bool is_in_use_ = false;  // whether there was such a frame
};

}  // namespace iog::map
