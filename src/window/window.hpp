// The world-aligned window: 32 by 32 tiles of the local frame around the vehicle.
//
// A tile that enters is unknown. It is cleared when something becomes known of it, and a group of
// it when something becomes known of the group, so that moving the window costs a flag a tile.
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
  // Moves the window if the vehicle is too far from its middle (Area::following). A window of which
  // nothing is known is centred on the vehicle.
  void follow(geometry::Cell vehicle);

  // Nothing is known of any tile.
  void forget();

  // Whether it has followed the vehicle since nothing was known.
  [[nodiscard]] bool is_centred() const { return is_centred_; }
  [[nodiscard]] const Area& area() const { return area_; }

  // Whether something was ever known of the tile at this slot.
  [[nodiscard]] bool is_known(std::size_t slot) const { return is_known_[slot]; }

  [[nodiscard]] const Tile& tile(std::size_t slot) const { return tiles_[slot]; }

  // The tile at a slot, to be changed; unknown before if nothing was known of it.
  Tile& open(std::size_t slot);

  // What is remembered of the ground in the tile at a slot, to be changed. Something is known of
  // it.
  Ground& ground(std::size_t slot) { return tiles_[slot].ground; }

  // By how many changes the tile at a slot came to be what it is, but for its ground. As long as it
  // stays, the classes of its cells do; nothing sets it back.
  [[nodiscard]] std::uint32_t version(std::size_t slot) const { return versions_[slot]; }

  // Nothing is known of the tile at a slot.
  void close(std::size_t slot) { is_known_[slot] = false; }

  // From now on the map rules this out in the tile at a slot, known or not, until it is said anew:
  // its cells are renamed, by the masses of when they were decided. Nothing else changes.
  void rule_out(std::size_t slot, const TileRuledOut& ruled_out);

  // What the cells of a group are called is again what their masses say, of when it was decided.
  void name_anew(std::size_t slot, std::size_t group);

  // Of the tile at a slot and of those around it what `plane_of` gives, where is_there(slot) says
  // that it is; outside of the window, and where it is not, no bit is set.
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

  // One of the planes of what was found.
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
