// What a receiver may believe of the link, whatever frames come: every tile that a message speaks
// of is as it was in the frame that the message names, and nothing is older than a round.
#include "serial/grid_sender.hpp"

#include <gtest/gtest.h>
#include <map>
#include <memory>
#include <vector>

#include "fakes/random.hpp"
#include "stream/references.hpp"
#include "tools/frames/tile_decoding.hpp"

namespace iog::serial {
namespace {

using geometry::kTileCount;
using Tile = std::array<std::byte, tile_coding::kTileBytes>;
using Grid = std::map<std::size_t, Tile>;  // known tiles

constexpr std::uint32_t kRate = 11'520;  // bytes a second

// A link that has no rate of its own, as QEMU's.
struct FakePort {
  std::vector<std::byte> bytes;
  std::size_t room = 1'000'000;

  [[nodiscard]] std::uint32_t bytes_per_second() const { return kRate; }
  [[nodiscard]] std::size_t free_bytes() const { return room; }
  void write(std::span<const std::byte> more) {
    ASSERT_LE(more.size(), room);
    bytes.insert(bytes.end(), more.begin(), more.end());
  }
  void pump() {}
};
static_assert(hal::SerialPort<FakePort>);

struct Message {
  stream::Header header;
  stream::TilesHeader tiles;
  Grid known;
  std::size_t bytes = 0;

  [[nodiscard]] bool is_of_cells() const {
    return tiles.geometry.storage == stream::Storage::kOccupancyIndex;
  }
};

class GridSenderOnALink : public testing::Test {
 protected:
  // A frame whose known tiles are those of the grid, and 40 ms of passes, one a millisecond.
  void play(std::uint32_t number, const Grid& grid, int milliseconds = 40) {
    sender_->begin_frame(
        {.frame_number = number, .closed_us = now_us_, .complete_sensors = sensors_});
    for (const auto& [tile, cells] : grid) {
      sender_->take_tile(tile, cells);
    }
    sender_->end_frame();
    pass(milliseconds);
  }

  void pass(int milliseconds) {
    for (; milliseconds > 0; --milliseconds) {
      sender_->pump(now_us_, port_);
      now_us_ += 1000;
    }
  }

  // The messages that have come since the last call, each found whole and in order.
  std::vector<Message> messages() {
    std::vector<Message> messages;
    for (const std::byte byte : port_.bytes) {
      const auto whole = cobs_.decode(byte);
      if (!whole) {
        continue;
      }
      const protection::Received received = receiver_.receive(*whole);
      EXPECT_EQ(received.header, protection::SomeIpStatus::kOk);
      EXPECT_EQ(received.check, protection::CheckStatus::kOk);
      messages.push_back(read(received.content));
      messages.back().bytes = whole->size();
    }
    EXPECT_EQ(cobs_.damaged(), 0u);
    port_.bytes.clear();
    return messages;
  }

  static Message read(std::span<const std::byte> content) {
    Message message;
    std::span<const std::byte> body;
    EXPECT_EQ(stream::read_header(content, message.header, body), stream::ReadStatus::kOk);
    stream::TileRecords records;
    EXPECT_EQ(stream::read_tiles(body, message.tiles, records), stream::ReadStatus::kOk);
    for (stream::TileRecord record; records.next(record);) {
      EXPECT_TRUE(stream::stands_by_itself(record.encoding));
      EXPECT_EQ(
          tile_coding::decode(record.encoding, record.payload, 0, {}, message.known[record.tile]),
          tile_coding::DecodeStatus::kOk);
    }
    return message;
  }

  // What the message says of its tiles, if it speaks of the grid's cells, is so.
  static void expect_true(const Message& message, const Grid& grid) {
    for (std::size_t tile = message.tiles.first_tile; tile < message.tiles.end_tile; ++tile) {
      const auto told = message.known.find(tile);
      const auto is = grid.find(tile);
      ASSERT_EQ(told == message.known.end(), is == grid.end()) << tile;
      if (is != grid.end()) {
        ASSERT_EQ(told->second, is->second) << tile;
      }
    }
  }

  // Tiles as a drive has them, 100 to 200 bytes each.
  static Grid street(std::uint64_t seed, int tiles) {
    tests::Random random(seed);
    Grid grid;
    for (int count = 0; count < tiles; ++count) {
      Tile cells;
      cells.fill(std::byte{0xF2});  // -14
      for (int things = 0; things < 60; ++things) {
        cells[random.below(cells.size())] = static_cast<std::byte>(random.between(-28, 6));
      }
      grid[random.below(kTileCount)] = cells;
    }
    return grid;
  }

  std::unique_ptr<GridSender> sender_ = std::make_unique<GridSender>();
  FakePort port_;
  std::uint8_t sensors_ = 1;  // that take part
  std::uint64_t now_us_ = 5000;
  std::array<std::byte, 1500> buffer_{};
  framing::CobsDecoder cobs_{buffer_};
  protection::Receiver receiver_{stream::kSerialChannel};
};

TEST_F(GridSenderOnALink, IsSilentBeforeTheFirstFrame) {
  pass(1000);
  EXPECT_TRUE(port_.bytes.empty());
}

TEST_F(GridSenderOnALink, BeginsWithTheRoughGridOfTheFrame) {
  play(7, street(1, 100));
  const std::vector<Message> all = messages();
  ASSERT_FALSE(all.empty());
  EXPECT_EQ(all[0].header.frame_number, 7u);
  EXPECT_EQ(all[0].tiles.geometry, stream::geometry_of_level(CoarseLevels::kRoughLevel));
  EXPECT_EQ(all[0].tiles.tile_count, 1u);
}

TEST_F(GridSenderOnALink, TellsOfEachFrameWhatIsSo) {
  std::vector<Grid> grids;
  for (std::uint32_t frame = 0; frame < 50; ++frame) {
    grids.push_back(street(frame, 20 + static_cast<int>(frame) * 5));
    play(frame, grids[frame]);
  }
  std::size_t told = 0;
  for (const Message& message : messages()) {
    if (message.is_of_cells()) {
      expect_true(message, grids.at(message.header.frame_number));
      told += message.known.size();
    }
  }
  EXPECT_GT(told, 50u);
}

TEST_F(GridSenderOnALink, TellsTheCoarseGridsWhole) {
  const Grid grid = street(3, 200);
  static CoarseLevels levels;
  levels.clear();
  for (const auto& [tile, cells] : grid) {
    levels.add_tile(tile, cells);
  }
  Tile rough{};
  levels.copy_rough(rough);
  for (std::uint32_t frame = 0; frame < 50; ++frame) {
    play(frame, grid);
  }
  std::array<bool, CoarseLevels::kFineTileCount> told{};
  for (const Message& message : messages()) {
    if (message.is_of_cells()) {
      continue;
    }
    if (message.tiles.geometry == stream::geometry_of_level(CoarseLevels::kRoughLevel)) {
      EXPECT_EQ(message.known.at(0), rough);
      continue;
    }
    ASSERT_EQ(message.tiles.geometry, stream::geometry_of_level(CoarseLevels::kFineLevel));
    for (const auto& [tile, cells] : message.known) {
      EXPECT_TRUE(std::ranges::equal(cells, levels.fine(tile)));
      told.at(tile) = true;
    }
  }
  EXPECT_EQ(std::ranges::count(told, true), std::ssize(told));
}

// 200 tiles of some 150 bytes are 30 kB, and two thirds of the link carry 7.7 kB a second.
TEST_F(GridSenderOnALink, HasToldAStillSceneInOneRound) {
  const Grid grid = street(2, 200);
  Grid told;
  std::uint32_t frame = 0;
  while (told.size() < grid.size() && frame < 200) {
    play(frame++, grid);
    for (const Message& message : messages()) {
      if (message.is_of_cells()) {
        told.insert(message.known.begin(), message.known.end());
      }
    }
  }
  EXPECT_EQ(told, grid);
  EXPECT_LT(frame, 125u);  // 5 s
}

TEST_F(GridSenderOnALink, TakesBackWhatIsNoLongerKnown) {
  for (std::uint32_t frame = 0; frame < 50; ++frame) {
    play(frame, street(2, 50));
  }
  static_cast<void>(messages());
  std::array<bool, kTileCount> is_taken_back{};
  for (std::uint32_t frame = 50; frame < 75; ++frame) {
    play(frame, {});
  }
  for (const Message& message : messages()) {
    if (message.is_of_cells() && message.header.frame_number >= 50) {
      EXPECT_TRUE(message.known.empty());
      for (std::size_t tile = message.tiles.first_tile; tile < message.tiles.end_tile; ++tile) {
        is_taken_back.at(tile) = true;
      }
    }
  }
  EXPECT_EQ(std::ranges::count(is_taken_back, true), std::ssize(is_taken_back));
}

// docs/spec.md 3.2: the absence of a sensor says nothing about any cell.
TEST_F(GridSenderOnALink, OnlyGivesASignOfLifeWhileNoSensorTakesPart) {
  for (std::uint32_t frame = 0; frame < 50; ++frame) {
    play(frame, street(2, 50));
  }
  static_cast<void>(messages());
  sensors_ = 0;
  for (std::uint32_t frame = 50; frame < 75; ++frame) {
    play(frame, {});
  }
  int signs = 0;
  for (const Message& message : messages()) {
    if (!message.header.has_evidence()) {
      EXPECT_EQ(message.tiles.geometry, stream::geometry_of_level(CoarseLevels::kRoughLevel));
      EXPECT_TRUE(message.known.empty());
      ++signs;
    }
  }
  EXPECT_GE(signs, 20);
  EXPECT_LE(signs, 25);
}

TEST_F(GridSenderOnALink, KeepsTheLinkBusyAndGoesNoFaster) {
  const Grid grid = street(4, 400);
  for (std::uint32_t frame = 0; frame < 100; ++frame) {
    play(frame, grid);
    EXPECT_LE(port_.bytes.size(), (frame + 1) * kRate / 25 + TokenBucket::burst_bytes(kRate));
  }
  EXPECT_GE(port_.bytes.size(), std::size_t{100} * kRate / 25 * 99 / 100);
}

TEST_F(GridSenderOnALink, GivesTheCellsTwoThirdsOfTheLine) {
  const Grid grid = street(4, 400);
  for (std::uint32_t frame = 0; frame < 200; ++frame) {
    play(frame, grid);
  }
  std::size_t of_cells = 0;
  std::size_t sum = 0;
  for (const Message& message : messages()) {
    of_cells += message.is_of_cells() ? message.bytes : 0;
    sum += message.bytes;
  }
  EXPECT_NEAR(static_cast<double>(of_cells), static_cast<double>(sum) * 2 / 3, 3 * 1400);
}

TEST_F(GridSenderOnALink, IsOfANewFrame) {
  for (std::uint32_t frame = 0; frame < 100; ++frame) {
    play(frame, street(4, 400));
    // The longest message lasts for 121 ms, and 40 ms of the one before it are left when it is
    // made.
    for (const Message& message : messages()) {
      EXPECT_LE(frame - message.header.frame_number, 5u);
    }
  }
}

TEST_F(GridSenderOnALink, WaitsForAPortWithoutRoom) {
  port_.room = 0;
  play(0, street(1, 100), 500);
  EXPECT_TRUE(port_.bytes.empty());
  port_.room = 3;
  const Grid next = street(9, 100);
  for (std::uint32_t frame = 1; frame < 40; ++frame) {
    play(frame, next);
  }
  port_.room = 1000;
  play(40, next);
  for (const Message& message : messages()) {
    if (message.is_of_cells() && message.header.frame_number > 0) {
      expect_true(message, next);
    }
  }
}

// Raw tiles, of which a message holds one, and frames in which everything is known.
TEST_F(GridSenderOnALink, TellsWhatIsSoOfGridsThatCannotBeCompressed) {
  tests::Random random(8);
  std::vector<Grid> grids(12);
  for (std::uint32_t frame = 0; frame < grids.size(); ++frame) {
    for (std::size_t tile = 0; tile < kTileCount; tile += 1 + random.below(40)) {
      for (std::byte& cell : grids[frame][tile]) {
        cell = static_cast<std::byte>(random.between(-127, 127));
      }
    }
    play(frame, grids[frame]);
  }
  for (const Message& message : messages()) {
    if (message.is_of_cells()) {
      expect_true(message, grids[message.header.frame_number]);
    }
  }
}

// docs/spec.md 3.2: the low 16 bits of the sequence number are the E2E counter, which the fixture's
// receiver follows.
TEST_F(GridSenderOnALink, NumbersItsMessages) {
  for (std::uint32_t frame = 0; frame < 25; ++frame) {
    play(frame, street(4, 50));
  }
  std::uint32_t sequence = 0;
  for (const Message& message : messages()) {
    EXPECT_EQ(message.header.sequence, sequence++);
  }
  EXPECT_GE(sender_->messages(), sequence);
}

}  // namespace
}  // namespace iog::serial
