#include "window/window.hpp"

#include "lanes/eight_bytes.hpp"
#include "work/before_images.hpp"

namespace iog::window {
namespace {

void name_by_masses(Tile& tile, std::size_t group) {
  constexpr evidence::Indexes kNoEvidence{};
  static_cast<void>(decision::decide(tile.free[group], tile.taken[group], tile.ruled_out[group],
                                     kNoEvidence, tile.decided[group]));
}

}  // namespace

void Window::follow(geometry::Cell vehicle) {
  const Area next = is_centred_ ? area_.following(vehicle) : Area::around(vehicle, area_.extent());
  is_centred_ = true;
  if (next.corner() == area_.corner()) {
    return;
  }
  for (std::size_t slot = 0; slot < kSlotCount; ++slot) {
    is_known_[slot] = is_known_[slot] && next.contains(area_.tile_at(slot));
  }
  area_ = next;
}

void Window::forget() {
  is_centred_ = false;
  is_known_.fill(false);
}

void Window::rule_out(std::size_t slot, const TileRuledOut& ruled_out) {
  Tile& tile = tiles_[slot];
  if (is_known_[slot]) {
    ++versions_[slot];
    rename(tile, ruled_out);
  }
  tile.ruled_out = ruled_out;
  tile.has_ruled_out = ruled_out != TileRuledOut{};
}

// A cell without a class keeps none, whatever the map says, so most masses need not be read.
void Window::rename(Tile& tile, const TileRuledOut& ruled_out) {
  for (std::size_t group = 0; group < kGroupsPerTile; ++group) {
    const decision::Decided& decided = tile.decided[group];
    if (tile.ruled_out[group] != ruled_out[group] &&
        !lanes::EightBytes::load(decided.data()).is_zero()) {
      tile.ruled_out[group] = ruled_out[group];
      name_by_masses(tile, group);
    }
  }
}

void Window::note_found(std::size_t slot) {
  std::uint32_t empty = 0;
  for (std::size_t i = 0; i < kFoundPlanes.size(); ++i) {
    empty |= std::uint32_t{is_empty(tiles_[slot].found.*kFoundPlanes[i])} << i;
  }
  empty_planes_[slot] = static_cast<std::uint8_t>(empty);
}

void Window::name_anew(std::size_t slot, std::size_t group) {
  if (is_known_[slot] && tiles_[slot].is_known(group)) {
    ++versions_[slot];
    name_by_masses(tiles_[slot], group);
  }
}

Tile& Window::open(std::size_t slot) {
  Tile& tile = tiles_[slot];
  ++versions_[slot];
  empty_planes_[slot] = 0;
  if (!is_known_[slot]) {
    tile.clear();
    work::keep_order();
    is_known_[slot] = true;
  }
  return tile;
}

}  // namespace iog::window
