// The serial link from the sender on the target to the receiver on the PC, and what the receiver
// believes when the line is bad.
#include <array>
#include <gtest/gtest.h>
#include <map>
#include <memory>
#include <vector>

#include "fakes/random.hpp"
#include "serial/grid_sender.hpp"
#include "tools/receive/serial/serial_link.hpp"

namespace iog::tools {
namespace {

using geometry::kTileCount;
using geometry::kTileSide;
using tile_coding::kTileBytes;
using Tile = std::array<std::byte, kTileBytes>;
using Grid = std::map<std::size_t, Tile>;  // known tiles

constexpr std::uint64_t kFrameUs = 40'000;
constexpr std::uint64_t kEver = 1'000'000'000;

struct Wire {
  std::vector<std::byte> bytes;
  [[nodiscard]] std::uint32_t bytes_per_second() const { return 11'520; }
  [[nodiscard]] std::size_t free_bytes() const { return 4096; }
  void write(std::span<const std::byte> more) {
    bytes.insert(bytes.end(), more.begin(), more.end());
  }
  void pump() {}
};

class Target {
 public:
  explicit Target(std::uint32_t run_number = 1, const geometry::Grid& grid = {})
      : run_number_{run_number} {
    sender_->describe(grid);
  }

  // Sends frames of these known tiles for a while, and returns the bytes on the line.
  std::vector<std::byte> send(const Grid& grid, int frames) {
    for (; frames > 0; --frames, ++frame_) {
      sender_->begin_frame({.frame_number = frame_,
                            .closed_us = now_us_,
                            .complete_sensors = 1,
                            .run_number = run_number_});
      for (const auto& [tile, cells] : grid) {
        sender_->take_tile(tile, cells);
      }
      sender_->end_frame();
      for (const std::uint64_t end_us = now_us_ + kFrameUs; now_us_ < end_us; now_us_ += 1000) {
        sender_->pump(now_us_, wire_);
      }
    }
    return std::exchange(wire_.bytes, {});
  }

 private:
  std::unique_ptr<serial::GridSender> sender_ = std::make_unique<serial::GridSender>();
  Wire wire_;
  std::uint32_t run_number_;
  std::uint32_t frame_ = 0;
  std::uint64_t now_us_ = 0;
};

Tile filled(int value) {
  Tile tile;
  tile.fill(static_cast<std::byte>(value));
  return tile;
}

Grid street(int tiles) {
  tests::Random random(3);
  Grid grid;
  for (int count = 0; count < tiles; ++count) {
    Tile cells = filled(-14);
    for (int things = 0; things < 40; ++things) {
      cells[random.below(kTileBytes)] = static_cast<std::byte>(random.between(-28, 6));
    }
    grid[random.below(kTileCount)] = cells;
  }
  return grid;
}

int at(const GridFrame& frame, std::size_t x, std::size_t y) {
  return frame.cells[y * geometry::kCellsPerSide + x];
}

void expect_cells(const GridFrame& frame, const Grid& grid) {
  for (std::size_t tile = 0; tile < kTileCount; ++tile) {
    const auto known = grid.find(tile);
    for (std::size_t i = 0; i < kTileBytes; ++i) {
      const int is = known == grid.end() ? 0 : static_cast<std::int8_t>(known->second[i]);
      ASSERT_EQ(frame.cells[cell_of_tile(tile, i)], is) << tile << " " << i;
    }
  }
}

TEST(SerialLink, HasAStillSceneCellByCell) {
  const Grid grid = street(60);
  Target target;
  SerialLink link;
  link.take(target.send(grid, 60));
  expect_cells(link.grid().composed(kEver), grid);
  const SerialCounts counts = link.counts();
  EXPECT_GT(counts.messages, 20u);
  EXPECT_EQ(counts.lost + counts.damaged + counts.malformed + counts.not_understood, 0u);
}

// 25.6 x 16 m ahead in cells of 5 cm: the cells, and where the car is.
TEST(SerialLink, TakesEachGrid) {
  constexpr geometry::Grid kAhead{
      .cell_mm = 50, .columns = 512, .rows = 320, .origin_column = 0, .origin_row = 160};
  Grid grid;  // in rows of 32 tiles, and what the car has in rows of 16
  Grid sent;
  for (const auto& [tile, cells] : street(60)) {
    if (tile % 32 < 16 && tile / 32 < 10) {
      grid[tile] = cells;
      sent[tile / 32 * 16 + tile % 32] = cells;
    }
  }
  ASSERT_GT(grid.size(), 5U);
  Target target(1, kAhead);
  SerialLink link;
  link.take(target.send(sent, 60));
  const GridFrame frame = link.grid().composed(kEver);
  expect_cells(frame, grid);
  EXPECT_EQ(link.counts().not_understood, 0U);
  EXPECT_EQ(frame.shape.cell_mm, 50);
  EXPECT_EQ(frame.shape.origin_column, 0);
  EXPECT_EQ(frame.shape.origin_row, 160);
}

TEST(SerialLink, CarriesNoGridWithALongSide) {
  Target target(1, {.columns = 2048, .rows = 512, .origin_row = 256});
  EXPECT_TRUE(target.send(street(60), 10).empty());
}

TEST(SerialLink, ForgetsWhatIsTakenBack) {
  Target target;
  SerialLink link;
  link.take(target.send(street(60), 60));
  link.take(target.send({}, 25));
  expect_cells(link.grid().composed(kEver), {});
}

TEST(SerialLink, JoinsInTheMiddleOfAMessage) {
  const Grid grid = street(60);
  Target target;
  const std::vector<std::byte> bytes = target.send(grid, 100);
  SerialLink link;
  link.take(std::span(bytes).subspan(bytes.size() / 3 + 5));
  expect_cells(link.grid().composed(kEver), grid);
  EXPECT_LE(link.counts().damaged, 1u);
  EXPECT_EQ(link.counts().lost, 0u);
}

// One byte in a thousand: hardly a whole message of cells comes through, but no wrong cell does.
TEST(SerialLink, BelievesNothingThatIsDamaged) {
  const Grid grid = street(60);
  Target target;
  tests::Random random(7);
  SerialLink link([&](std::size_t tile, const ToldTile& told) {
    ASSERT_EQ(told.cells.has_value(), grid.contains(tile)) << tile;
    ASSERT_TRUE(!told.cells || *told.cells == grid.at(tile)) << tile;
  });
  for (int second = 0; second < 8; ++second) {
    std::vector<std::byte> bytes = target.send(grid, 25);
    for (std::byte& byte : bytes) {
      byte = random.one_in(1000) ? static_cast<std::byte>(random.next()) : byte;
    }
    link.take(bytes);
  }
  EXPECT_GT(link.counts().damaged, 10u);
  EXPECT_GT(link.counts().lost, 10u);
  EXPECT_GT(link.counts().messages, 10u);
}

TEST(SerialLink, ANewRunReplacesTheOldOne) {
  SerialLink link;
  Target first(7);
  link.take(first.send(street(60), 60));
  Target second(8);
  link.take(second.send({}, 25));
  EXPECT_EQ(link.counts().restarts, 1u);
  EXPECT_EQ(link.counts().lost, 0u);
  EXPECT_LT(link.grid().newest()->frame_number, 25u);
  expect_cells(link.grid().composed(kEver), {});
}

// The receiver was away while the new run sent more messages than the old one had, for longer. No
// number but that of the run tells.
TEST(SerialLink, ANewRunReplacesTheOldOneThoughAllElseGoesOn) {
  SerialLink link;
  Target first(7);
  link.take(first.send(street(60), 15));
  const std::uint32_t last = link.grid().newest()->frame_number;
  Target second(0xFFFFFFFF);
  static_cast<void>(second.send({}, 60));  // many short messages
  link.take(second.send({}, 1));
  ASSERT_TRUE(link.grid().newest());
  EXPECT_GT(link.grid().newest()->frame_number, last);
  EXPECT_EQ(link.counts().restarts, 1u);
  EXPECT_EQ(link.counts().lost, 0u);
  expect_cells(link.grid().composed(kEver), {});
}

// A file that was written twice, say.
TEST(SerialLink, AnOldMessageOfTheRunIsDropped) {
  const Grid grid = street(60);
  Target target;
  SerialLink link;
  const std::vector<std::byte> bytes = target.send(grid, 30);
  link.take(bytes);
  const SerialCounts once = link.counts();
  const std::uint32_t newest = link.grid().newest()->frame_number;
  link.take(bytes);
  EXPECT_EQ(link.counts().messages, once.messages);
  EXPECT_EQ(link.counts().repeated + link.counts().damaged, once.messages)
      << "the first may be cut, where the file ends and begins again";
  EXPECT_EQ(link.counts().restarts, 0u);
  EXPECT_EQ(link.grid().newest()->frame_number, newest);
}

TEST(SerialLink, AnotherVersionIsRefusedByName) {
  protection::Channel other = stream::kSerialChannel;
  other.event.interface_version = 3;
  protection::Sender sender(other);
  stream::TilesWriter writer;
  writer.begin_grid({.complete_sensors = 1}, stream::geometry_of_level(5));
  const auto message = writer.finish(1, 0);
  sender.protect(message);
  std::array<std::byte, framing::max_framed_bytes(protection::kMaxMessageBytes)> frame{};
  SerialLink link;
  link.take(std::span(frame).first(framing::encode_cobs(message, frame)));
  EXPECT_EQ(link.version_sent(), 3);
  EXPECT_EQ(link.counts().other_version, 1u);
  EXPECT_EQ(link.counts().messages + link.counts().not_ours + link.counts().damaged, 0u);
}

ToldTile told(std::uint64_t closed_us, int value) {
  return {.frame_number = 1, .closed_us = closed_us, .cells = filled(value)};
}

class Layers : public testing::Test {
 protected:
  void take(unsigned level, std::size_t tile, std::uint64_t closed_us, int value) {
    const std::array<std::optional<ToldTile>, 1> tiles{told(closed_us, value)};
    grid_.take(level, {}, tile, tiles, {.closed_us = closed_us, .complete_sensors = 1});
  }
  LayeredGrid grid_;
};

TEST_F(Layers, CellsLieOverTheFineGridAndThatOverTheRoughOne) {
  take(5, 0, 1000, -1);
  take(3, 0, 1000, -2);
  take(0, 0, 1000, -3);
  const GridFrame frame = grid_.composed(kEver);
  EXPECT_EQ(at(frame, 0, 0), -3);
  EXPECT_EQ(at(frame, kTileSide, 0), -2);
  EXPECT_EQ(at(frame, kTileSide * 8 - 1, kTileSide * 8 - 1), -2);
  EXPECT_EQ(at(frame, kTileSide * 8, 0), -1);
  EXPECT_EQ(at(frame, 1023, 1023), -1);
}

TEST_F(Layers, WhatIsTooOldIsNotShown) {
  take(0, 0, 1'000'000, -3);
  take(3, 0, 2'000'000, -2);
  take(0, 1, 4'000'000, -4);
  EXPECT_EQ(at(grid_.composed(3'000'000), 0, 0), -3);
  EXPECT_EQ(at(grid_.composed(2'999'999), 0, 0), -2);
  EXPECT_EQ(at(grid_.composed(1'000'000), 0, 0), 0);
  EXPECT_EQ(at(grid_.composed(0), kTileSide, 0), -4);
}

TEST_F(Layers, AnUnknownTileHidesWhatIsBelow) {
  take(5, 0, 1000, 7);
  const std::array<std::optional<ToldTile>, 2> tiles{ToldTile{.frame_number = 1, .closed_us = 1000},
                                                     std::nullopt};
  grid_.take(0, {}, 0, tiles, {.closed_us = 1000, .complete_sensors = 1});
  EXPECT_EQ(at(grid_.composed(kEver), 0, 0), 0);
  EXPECT_EQ(at(grid_.composed(kEver), kTileSide, 0), 7);
}

TEST_F(Layers, AFrameInWhichNoSensorTookPartSaysNothingOfAnyCell) {
  take(0, 0, 1000, -3);
  const std::array<std::optional<ToldTile>, 1> nothing{ToldTile{.closed_us = 9000}};
  grid_.take(5, {}, 0, nothing, {.closed_us = 9000});
  EXPECT_EQ(at(grid_.composed(0), 0, 0), -3);
  EXPECT_EQ(grid_.newest_seen()->closed_us, 1000u);
  EXPECT_EQ(grid_.age_us(*grid_.cells_of(0)), 8000u);
}

TEST_F(Layers, NothingIsUnknown) { expect_cells(grid_.composed(kEver), {}); }

}  // namespace
}  // namespace iog::tools
