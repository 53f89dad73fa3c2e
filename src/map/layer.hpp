// The map's layer of the window: which tiles are drawn, which wait, and which have to be drawn
// again.
//
// A tile waits from the frame in which it enters the window, in which there is another map, in
// which the transform has moved one of its corners by more than a cell since it was drawn, or in
// which the blur is wider than the one it was drawn with. A narrower one changes nothing: what is
// drawn says less than it might, and nothing wrong. While a tile waits, anything is possible in it.
// The one that began to wait first is drawn first, of those that began in one frame that of the
// lowest slot.
//
// A map that the sensors contradict (map/agreement.hpp) is still drawn, to find when it agrees
// again, but rules nothing out.
//
// A frame has a budget of work, in edges: kWorkPerFrame. What is not done waits, also in the middle
// of a tile; a tile is shown when it is whole.
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

// In edges that are looked at. An edge that crosses the tile is as much as kWorkPerCrossing of
// them, an entry of the block's index as one, and the other work on a tile as the constants say.
inline constexpr std::uint32_t kWorkPerFrame = 8'192;
inline constexpr std::uint32_t kWorkPerTile = 256;
inline constexpr std::uint32_t kWorkPerTileOutside = 32;

// The radius of the blur in cells, rounded up: the map's accuracy, two deviations of the transform
// at 50 m, and the diagonal of a cell. At most 2^18.
[[nodiscard]] constexpr std::uint32_t blur_radius(std::uint32_t accuracy_mm,
                                                  const pose::Sigma& sigma) {
  constexpr std::uint32_t kCell = geometry::kCellMm;
  // 2 * 50 m * 10 urad is a millimetre.
  const std::uint32_t mm =
      accuracy_mm + 2U * sigma.position_mm + sigma.heading_10urad + kCell * 14 / 10;
  return (mm + kCell - 1) / kCell;
}

class Layer {
 public:
  Layer() = default;
  Layer(const Layer&) = delete;
  Layer& operator=(const Layer&) = delete;

  // Once a frame, after the window has followed the vehicle. block: the active one, or null; its
  // bytes stay until another call. transform: that of the newest pose, if it has one.
  void work(const Block* block, const std::optional<pose::MapTransform>& transform,
            perception::WindowFusion& window);

  // Instead, in a frame that is none of the window's: only the report says what there is. So a
  // pause of all who send leaves no trace in what is drawn when.
  void look(const Block* block, const std::optional<pose::MapTransform>& transform,
            const perception::WindowFusion& window);

  // Of the last frame.
  [[nodiscard]] const LayerReport& report() const { return report_; }

 private:
  enum class State : std::uint8_t {
    kIdle,     // there is a cause, or there was never a map
    kWaiting,  // to be drawn
    kDrawn,
    kOutside,
  };

  // By what a tile is drawn.
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

  void take_inputs(const Block* block, const std::optional<pose::MapTransform>& transform);
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

  // By slot, each apart from the others: a frame that looks at all states reads nothing else.
  std::array<State, window::kSlotCount> states_{};
  std::array<std::uint32_t, window::kSlotCount> since_{};  // which frame a tile has waited
  std::array<Basis, window::kSlotCount> bases_{};          // of a tile that is drawn or outside
  std::array<window::Plane, window::kSlotCount> inside_buildings_{};  // of a tile that is drawn
  Agreement agreement_;
  SlotSet waiting_;
  std::array<std::uint16_t, 4> counts_{window::kSlotCount};  // of slots by state
  std::optional<Unfinished> unfinished_;
  window::TileRuledOut ruled_out_{};
  LayerReport report_;
  std::uint32_t frame_ = 0;
  std::uint32_t budget_ = 0;  // of work that this frame still has
  Basis now_{};
  // Of the last frame without a cause:
  Basis basis_{};
  window::Area area_;
  std::uint32_t crc_ = 0;
  const std::byte* data_ = nullptr;
  bool is_in_use_ = false;  // whether there was one
};

}  // namespace iog::map
