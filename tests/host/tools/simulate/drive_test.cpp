#include "tools/simulate/drives/drive.hpp"

#include <algorithm>
#include <array>
#include <filesystem>
#include <map>
#include <string>
#include <string_view>

#include "gtest/gtest.h"

#include "../drive_sample.hpp"
#include "fakes/temporary_folder.hpp"
#include "lidar/ibeo_lux.hpp"
#include "stream/crc32.hpp"
#include "tools/formats/lux/lux_scan.hpp"
#include "tools/formats/picture/pgm.hpp"
#include "tools/frames/frame_assembler.hpp"
#include "tools/program/exit_status.hpp"
#include "tools/program/file.hpp"
#include "tools/simulate/truth/true_occupancy.hpp"

namespace iog::tools {
namespace {

const CatalogueEntry& reference_car() { return find_vehicle("reference_car"); }

std::uint32_t crc_of(const std::vector<CapturedDatagram>& datagrams) {
  stream::Crc32 crc;
  for (const CapturedDatagram& datagram : datagrams) {
    crc.update(datagram.payload);
  }
  return crc.value();
}

// What every scene promises.
class DriveThrough : public testing::TestWithParam<std::string_view> {};

INSTANTIATE_TEST_SUITE_P(Scenes, DriveThrough, testing::Values("city", "ring_road"),
                         [](const auto& scene) { return std::string(scene.param); });

TEST_P(DriveThrough, SameSeedSameBytes) {
  const auto once = sample_drive(reference_car(), 1, 5, GetParam());
  EXPECT_EQ(crc_of(once), crc_of(sample_drive(reference_car(), 1, 5, GetParam())));
  EXPECT_NE(crc_of(once), crc_of(sample_drive(reference_car(), 2, 5, GetParam())));
}

// Every compiler and machine must get these bytes; whoever changes the world on purpose pins anew.
TEST(Drive, BytesArePinned) {
  EXPECT_EQ(crc_of(sample_drive(reference_car(), 1, 25)), 0x9059EC79U);
  EXPECT_EQ(crc_of(sample_drive(find_vehicle("two_lux_parking"), 1, 25)), 0x3956DB96U);
  EXPECT_EQ(crc_of(sample_drive(reference_car(), 1, 25, "ring_road")), 0x9A9FA793U);
}

TEST_P(DriveThrough, EveryPacketIsAcceptedAndEveryScanCovers100Degrees) {
  std::map<std::pair<std::uint16_t, std::uint32_t>, std::uint32_t> swept_ticks;
  for (const CapturedDatagram& datagram : sample_drive(reference_car(), 7, 25, GetParam())) {
    EXPECT_LE(datagram.payload.size(), kMaxLuxDatagramBytes);
    lidar::IbeoLux decoder;
    ASSERT_EQ(decoder.decode(datagram.payload), lidar::DecodeStatus::kOk);
    swept_ticks[{datagram.destination.port, decoder.info().scan_number}] +=
        decoder.info().sector.width_ticks;
  }
  EXPECT_EQ(swept_ticks.size(), 4U * 25U);
  for (const auto& [scan, ticks] : swept_ticks) {
    EXPECT_EQ(ticks, 3200U);
  }
}

TEST(Drive, ABurstEndsWithinTwoMillisecondsOfTheScan) {
  for (const std::uint32_t frames : {1U, 2U}) {
    const auto datagrams = sample_drive(reference_car(), 3, frames);
    const std::uint64_t first_us = datagrams.front().time_us + std::uint64_t{frames - 1} * 40'000;
    EXPECT_LT(datagrams.back().time_us - first_us, 2'500U);
  }
}

TEST_P(DriveThrough, EveryFrameIsCompleteAndHasEchoesOfEveryKind) {
  std::array<std::uint64_t, vehicle::kFateCount> fates{};
  std::uint64_t complete = 0;
  FrameAssembler assembler([&](const GridFrame& frame) {
    complete += frame.header.complete_sensors == 0xF ? 1U : 0U;
    for (std::size_t i = 0; i < fates.size(); ++i) {
      fates[i] += frame.end.fates[i];
    }
  });
  const auto datagrams = sample_drive(reference_car(), 1, 25, GetParam());
  for (const auto& message : messages_of(reference_car(), datagrams)) {
    assembler.take(message);
  }
  EXPECT_EQ(complete, 25U);
  using vehicle::Fate;
  for (const Fate fate :
       {Fate::kUsed, Fate::kTooFar, Fate::kOutsideHeightBand, Fate::kFlagged, Fate::kLaterEcho}) {
    EXPECT_GT(fates[static_cast<std::size_t>(fate)], 25U);
  }
  EXPECT_EQ(fates[static_cast<std::size_t>(Fate::kMalformed)], 0U);
}

TEST(Solid, ARayMeetsTheNearFaceOfABox) {
  const Solid wall = box(Material::kWall, {.x = 10, .y = 0}, 2, 4, 0, 3);
  EXPECT_DOUBLE_EQ(distance_to(wall, {{0, 0, 1}, {1, 0, 0}}), 9);
  EXPECT_DOUBLE_EQ(distance_to(wall, {{0, 1.9, 1}, {1, 0, 0}}), 9);
  EXPECT_EQ(distance_to(wall, {{0, 2.1, 1}, {1, 0, 0}}), kNoHit);
  EXPECT_EQ(distance_to(wall, {{0, 0, 3.1}, {1, 0, 0}}), kNoHit);
  EXPECT_EQ(distance_to(wall, {{20, 0, 1}, {1, 0, 0}}), kNoHit);
  EXPECT_EQ(distance_to(wall, {{10, 0, 1}, {1, 0, 0}}), kNoHit);  // from inside
}

TEST(Solid, ARayMeetsTheRoundOfACylinder) {
  const Solid pole = cylinder(Material::kPole, 5, 0, 0.5, 0, 2);
  EXPECT_DOUBLE_EQ(distance_to(pole, {{0, 0, 1}, {1, 0, 0}}), 4.5);
  EXPECT_EQ(distance_to(pole, {{0, 0.6, 1}, {1, 0, 0}}), kNoHit);
  EXPECT_EQ(distance_to(pole, {{0, 0, 2.5}, {1, 0, 0}}), kNoHit);
}

TEST(Truth, MarksTheCellsWhoseCentresAreCovered) {
  // 0.2 m by 0.4 m, its corner at the origin: cells (512, 512) to (513, 515).
  const std::vector<Solid> solids{
      box(Material::kWall, {.x = 0.1, .y = 0.2}, 0.2, 0.4, 0, 1),
      box(Material::kKerb, {.x = -5, .y = -5}, 1, 1, 0, 0.12),  // below the height band
      cylinder(Material::kFoliage, 8, 8, 1, 2.4, 6)};           // above it
  const auto occupied = true_occupancy({}, solids, *reference_car().description);
  std::size_t count = 0;
  for (const bool is_occupied : occupied) {
    count += is_occupied ? 1U : 0U;
  }
  EXPECT_EQ(count, 8U);
  EXPECT_TRUE(occupied[512 * 1024 + 512]);
  EXPECT_TRUE(occupied[515 * 1024 + 513]);
}

// The same wall on a grid of 51.2 x 32 m ahead in cells of 5 cm, and one behind the car.
TEST(Truth, HasTheGridOfTheCar) {
  const std::vector<Solid> solids{box(Material::kWall, {.x = 0.1, .y = 0.2}, 0.2, 0.4, 0, 1),
                                  box(Material::kWall, {.x = -3, .y = 0}, 1, 1, 0, 1)};
  description::Description car = *reference_car().description;
  car.grid = {.cell_m = 0.05, .ahead_m = 51.2, .behind_m = 0, .left_m = 16, .right_m = 16};
  const auto occupied = true_occupancy({}, solids, car);
  EXPECT_EQ(std::ranges::count(occupied, true), 32);
  EXPECT_TRUE(occupied[320 * 1024]);
  EXPECT_TRUE(occupied[327 * 1024 + 3]);
}

TEST(Truth, TakesThePlaceOfItsOwnPicturesAlone) {
  const tests::TemporaryFolder folder;
  make_truth_folder(folder.path());
  const std::vector<bool> nothing(geometry::kCellCount, false);
  write_truth(folder / "truth_000025.pgm", nothing, {});
  make_truth_folder(folder.path());
  EXPECT_THROW(static_cast<void>(read_file(folder / "truth_000025.pgm")), UsageError);
  write_truth(folder / "truth_000050.pgm", nothing, {});
  for (const char* const mine : {"truth_000000.pgm", "truth_000100.pgm"}) {
    write_pgm(folder / mine, 1, 1, std::array{std::uint8_t{255}});
    EXPECT_THROW(make_truth_folder(folder.path()), UsageError) << mine;
    EXPECT_EQ(read_file(folder / mine).size(), 12U) << mine;
    std::filesystem::rename(folder / mine, folder / "truth.pgm");
  }
  EXPECT_FALSE(read_file(folder / "truth_000050.pgm").empty());
}

}  // namespace
}  // namespace iog::tools
