// The window moves by whole tiles: what stays is as it was, what enters is unknown.
#include "window/window.hpp"

#include <cstdlib>
#include <gtest/gtest.h>
#include <memory>
#include <string>

namespace iog::window {
namespace {

using geometry::Cell;

// Writes a tile's own numbers into it, so that it is recognised.
void sign(Tile& tile, TileNumber number) {
  tile.free[7][3] = static_cast<std::int16_t>(number.a & 0x7FFF);
  tile.taken[127].persistence[7] = static_cast<std::int16_t>(number.b & 0x7FFF);
  for (Plane* plane : {&tile.found.freed, &tile.found.seen, &tile.found.stands, &tile.found.taken,
                       &tile.ground.open, &tile.ground.dense, &tile.ground.ticks_low,
                       &tile.ground.ticks_high, &tile.from_below}) {
    plane->fill(0x8000'0001U);
  }
  tile.aged_at.fill(5);
  tile.evidence_at.fill(6);
  tile.is_free_alone.fill(true);
}

bool is_signed(const Tile& tile, TileNumber number) {
  return tile.free[7][3] == (number.a & 0x7FFF) &&
         tile.taken[127].persistence[7] == (number.b & 0x7FFF);
}

bool is_unknown(const Tile& tile) {
  constexpr Plane kNothing{};
  const std::array<std::uint8_t, kGroupsPerTile> never{};
  const std::array<bool, kGroupsPerTile> no{};
  return tile.aged_at == never && tile.evidence_at == never && tile.is_free_alone == no &&
         tile.found.freed == kNothing && tile.found.seen == kNothing &&
         tile.found.stands == kNothing && tile.found.taken == kNothing &&
         tile.ground.open == kNothing && tile.ground.dense == kNothing &&
         tile.ground.ticks_low == kNothing && tile.ground.ticks_high == kNothing &&
         tile.from_below == kNothing;
}

// A window of which all tiles are known.
std::unique_ptr<Window> full_window(Cell vehicle) {
  auto window = std::make_unique<Window>();
  window->follow(vehicle);
  for (std::size_t slot = 0; slot < kSlotCount; ++slot) {
    sign(window->open(slot), window->area().tile_at(slot));
  }
  return window;
}

struct Move {
  std::int32_t x;  // tiles
  std::int32_t y;
};

class WindowMoves : public testing::TestWithParam<Move> {};

TEST_P(WindowMoves, OnlyWhatEntersIsUnknown) {
  const auto [x, y] = GetParam();
  for (const Cell start : {Cell{0, 0}, Cell{-10'000'000, 10'000'000}, Cell{16 * 32, -16 * 32}}) {
    const auto window = full_window(start);
    const Area before = window->area();
    window->follow({start.x + x * kTileSide, start.y + y * kTileSide});
    ASSERT_EQ(window->area().corner(), (TileNumber{before.corner().a + x, before.corner().b + y}));
    for (std::size_t slot = 0; slot < kSlotCount; ++slot) {
      const TileNumber tile = window->area().tile_at(slot);
      const bool stayed = before.contains(tile);
      ASSERT_EQ(window->is_known(slot), stayed);
      ASSERT_TRUE(stayed ? is_signed(window->tile(slot), tile) : is_unknown(window->open(slot)));
    }
  }
}

INSTANTIATE_TEST_SUITE_P(By, WindowMoves,
                         testing::Values(Move{2, 0}, Move{-2, 0}, Move{0, 2}, Move{0, -2},
                                         Move{3, -5}, Move{-31, 31}, Move{32, 0}, Move{0, -700}),
                         [](const auto& move) {
                           const auto name = [](std::int32_t tiles) {
                             return (tiles < 0 ? "Minus" : "") + std::to_string(std::abs(tiles));
                           };
                           return name(move.param.x) + "And" + name(move.param.y);
                         });

TEST(Window, StaysWhileTheVehicleIsNearItsMiddle) {
  const auto window = full_window({0, 0});
  for (const Cell near : {Cell{31, 31}, Cell{-32, 31}, Cell{31, -32}, Cell{-32, -32}}) {
    window->follow(near);
    ASSERT_EQ(window->area().corner(), (TileNumber{-16, -16}));
  }
  EXPECT_TRUE(window->is_known(slot_of({15, 15})));
}

TEST(Window, IsCentredAgainAfterItForgot) {
  const auto window = full_window({0, 0});
  window->forget();
  EXPECT_FALSE(window->is_centred());
  for (std::size_t slot = 0; slot < kSlotCount; ++slot) {
    ASSERT_FALSE(window->is_known(slot));
  }
  window->follow({20, -20});  // near enough to the middle, but nothing is lost by moving
  EXPECT_EQ(window->area().corner(), (TileNumber{-15, -17}));
  EXPECT_TRUE(is_unknown(window->open(slot_of({3, 3}))));
}

// Of nine planes those that are there and in the window.
TEST(Window, ShowsATileAmongItsNeighbours) {
  const auto window = full_window({0, 0});
  window->open(slot_of({-16, -15})).found.freed[4] = 77;  // at the left border of the window
  window->open(slot_of({-15, -14})).found.freed[4] = 78;  // up and right of it
  window->open(slot_of({15, -15})).found.freed[4] = 79;   // its neighbour by slot, across the seam
  const NinePlanes nine = window->around(slot_of({-16, -15}), &Found::freed);
  EXPECT_EQ((*nine[4])[4], 77U);
  EXPECT_EQ((*nine[8])[4], 78U);
  for (const std::size_t outside : {0U, 3U, 6U}) {
    EXPECT_EQ((*nine[outside])[4], 0U);
  }
}

}  // namespace
}  // namespace iog::window
