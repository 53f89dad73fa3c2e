// The world-aligned window, which consists of tiles of the local frame around the vehicle. The
// window has 32 by 32 tiles, unless the car file specifies fewer. Memory for 32 by 32 tiles is
// always allocated.
//
// When a tile enters the window, it is only marked as unknown. The memory of each tile, and of each
// group in it, is cleared just before the first write to it. Moving the window therefore writes
// only one flag per tile.
#pragma once

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>

#include "window/area.hpp"
#include "window/rows.hpp"
#include "window/tile.hpp"

namespace iog::window {

class Window {
 public:
  explicit Window(Extent extent = {}) : area_(TileNumber{}, extent) {}

  // Moves the window if the vehicle is too far from the window's middle (Area::following). The
  // first call, and the first call after forget(), centre the window on the vehicle.
  void follow(geometry::Cell vehicle);

  // Sets all tiles to unknown.
  void forget();

  // Returns true if follow() has been called since the window was created or last cleared by
  // forget().
  [[nodiscard]] bool is_centred() const { return is_centred_; }
  [[nodiscard]] const Area& area() const { return area_; }

  // Returns true if the tile in a slot is known.
  [[nodiscard]] bool is_known(std::size_t slot) const { return is_known_[slot]; }

  [[nodiscard]] const Tile& tile(std::size_t slot) const { return tiles_[slot]; }

  // Returns a mutable reference to the tile in a slot. If the tile is unknown, it is cleared first.
  Tile& open(std::size_t slot);

  // Returns a mutable reference to the ground memory of the tile in a slot. The tile must be known.
  Ground& ground(std::size_t slot) { return tiles_[slot].ground; }

  // Returns the version of the tile in a slot. The version counts all changes to the tile except
  // those to its ground memory, and is never reset. While the version stays the same, the classes
  // of the tile's cells stay the same.
  [[nodiscard]] std::uint32_t version(std::size_t slot) const { return versions_[slot]; }

  // Sets the tile in a slot to unknown.
  void close(std::size_t slot) { is_known_[slot] = false; }

  // Records which classes the map rules out in a tile. The record applies until the next call for
  // the same slot. The tile may be unknown. The call reclassifies the tile's cells based on the
  // same masses as in their last classification. It changes nothing else.
  void rule_out(std::size_t slot, const TileRuledOut& ruled_out);

  // Restores the classes from a group's last classification by recomputing them from its masses.
  void name_anew(std::size_t slot, std::size_t group);

  // Records which planes of the tile's `found` member are empty. The record is valid until the tile
  // is opened again.
  void note_found(std::size_t slot);

  // Returns false if the tile is unknown or if note_found() has recorded that the plane is empty.
  [[nodiscard]] bool may_have(std::size_t slot, Plane Found::*plane) const {
    return is_known_[slot] && (empty_planes_[slot] & bit_of(plane)) == 0;
  }

  // Returns true if all planes returned by around() are known to be empty.
  [[nodiscard]] static bool are_empty(const NinePlanes& nine) {
    return std::ranges::all_of(nine, [](const Plane* plane) { return plane == &kNothing; });
  }

  // Returns the planes that `plane_of` returns for the tile in a slot and for its neighbours. If a
  // tile is outside the window or is_there(slot) is false, its plane is empty.
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

  // Returns one plane of `found` for the tile in a slot and for its neighbours. Planes that are
  // known to be empty are not read.
  [[nodiscard]] NinePlanes around(std::size_t slot, Plane Found::*plane) const {
    return around(
        slot, [this, plane](std::size_t at) { return may_have(at, plane); },
        [this, plane](std::size_t at) -> const Plane& { return tiles_[at].found.*plane; });
  }

 private:
  static constexpr Plane kNothing{};
  static constexpr std::array kFoundPlanes{&Found::freed, &Found::seen, &Found::stands,
                                           &Found::taken};

  static constexpr std::uint8_t bit_of(Plane Found::*plane) {
    return static_cast<std::uint8_t>(
        1U << (std::ranges::find(kFoundPlanes, plane) - kFoundPlanes.begin()));
  }

  static void rename(Tile& tile, const TileRuledOut& ruled_out);

  Area area_;
  bool is_centred_ = false;
  std::array<bool, kSlotCount> is_known_{};
  std::array<std::uint32_t, kSlotCount> versions_{};
  std::array<std::uint8_t, kSlotCount> empty_planes_{};  // one bit per plane of Found
  std::array<Tile, kSlotCount> tiles_{};
};

}  // namespace iog::window
