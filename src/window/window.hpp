// The world-aligned window, with 32 by 32 tiles of the local frame around the vehicle.
//
// A tile that enters the window is only flagged as unknown. The memory of the tile is cleared just
// before the first write to the tile, and the memory of each group is cleared just before the first
// write to the group. Moving the window therefore only costs one flag per tile.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>

#include "window/area.hpp"
#include "window/rows.hpp"
#include "window/tile.hpp"

namespace iog::window {

class Window {
 public:
  // Moves the window if the vehicle is too far from the window's middle (Area::following). A window
  // without content is centred on the vehicle.
  void follow(geometry::Cell vehicle);

  // Sets all tiles to unknown.
  void forget();

  // Returns true if the window has followed the vehicle since it was last cleared.
  [[nodiscard]] bool is_centred() const { return is_centred_; }
  [[nodiscard]] const Area& area() const { return area_; }

  // Returns true if the tile at this slot has ever been known.
  [[nodiscard]] bool is_known(std::size_t slot) const { return is_known_[slot]; }

  [[nodiscard]] const Tile& tile(std::size_t slot) const { return tiles_[slot]; }

  // Returns the tile at a slot for writing. An unknown tile is cleared first.
  Tile& open(std::size_t slot);

  // Returns the ground memory of the tile at a slot for writing. The tile must be known.
  Ground& ground(std::size_t slot) { return tiles_[slot].ground; }

  // Returns the number of changes to the tile at a slot. Changes to the tile's ground are not
  // counted. While the version stays the same, the classes of the tile's cells stay the same. The
  // number is never reset.
  [[nodiscard]] std::uint32_t version(std::size_t slot) const { return versions_[slot]; }

  // Sets the tile at a slot to unknown.
  void close(std::size_t slot) { is_known_[slot] = false; }

  // Sets the map classes ruled out in the tile at a slot. The ruled-out classes apply until the
  // next call. The tile may be unknown. The call reclassifies the tile's cells with the masses of
  // their last classification, and changes nothing else.
  void rule_out(std::size_t slot, const TileRuledOut& ruled_out);

  // Restores the classes that a group had after its last classification, using the group's masses.
  void name_anew(std::size_t slot, std::size_t group);

  // Returns the planes that `plane_of` returns for the tile at a slot and its neighbours. For tiles
  // outside the window, and for tiles for which is_there(slot) is false, no bit is set.
  template <typename IsThere, typename PlaneOf>
  [[nodiscard]] NinePlanes around(std::size_t slot, IsThere&& is_there, PlaneOf&& plane_of) const {
    const TileNumber middle = area_.tile_at(slot);
    NinePlanes nine{};
    for (std::size_t i = 0; i < nine.size(); ++i) {
      const auto column = static_cast<std::int32_t>(i % 3);
      const auto row = static_cast<std::int32_t>(i / 3);
      const TileNumber tile{middle.a + column - 1, middle.b + row - 1};
      const std::size_t at = slot_of(tile);
      nine[i] = area_.contains(tile) && is_there(at) ? &plane_of(at) : &kNothing;
    }
    return nine;
  }

  // Has the same effect as the function above, for a plane of Found.
  [[nodiscard]] NinePlanes around(std::size_t slot, Plane Found::*plane) const {
    return around(
        slot, [this](std::size_t at) { return is_known_[at]; },
        [this, plane](std::size_t at) -> const Plane& { return tiles_[at].found.*plane; });
  }

 private:
  static constexpr Plane kNothing{};

  static void rename(Tile& tile, const TileRuledOut& ruled_out);

  Area area_;
  bool is_centred_ = false;
  std::array<bool, kSlotCount> is_known_{};
  std::array<std::uint32_t, kSlotCount> versions_{};
  std::array<Tile, kSlotCount> tiles_{};
};

}  // namespace iog::window
