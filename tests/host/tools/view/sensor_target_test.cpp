#include "tools/view/sensor_target.hpp"

#include <algorithm>
#include <iterator>

#include "gtest/gtest.h"

#include "../drive_sample.hpp"
#include "page_reader.hpp"
#include "tools/simulate/drives/drive.hpp"
#include "tools/simulate/drives/pose_source.hpp"

namespace iog::tools::view {
namespace {

constexpr std::uint32_t kFrames = 3;

std::vector<GridFrame> frames_of(const CatalogueEntry& car,
                                 const std::vector<CapturedDatagram>& drive) {
  std::vector<GridFrame> frames;
  FrameAssembler assembler([&](GridFrame&& frame) { frames.push_back(std::move(frame)); });
  for (const auto& message : messages_of(car, drive)) {
    assembler.take(message);
  }
  assembler.finish();
  return frames;
}

// What a page sees is what `iog fuse` computes, with the points of the very frame.
TEST(SensorTarget, ShowsTheGridsOfTheTargetWithTheirPoints) {
  const CatalogueEntry& car = find_vehicle("reference_car");
  const auto drive = sample_drive(car, 1, kFrames);
  const auto expected = frames_of(car, drive);
  const auto scene = std::make_unique<Scene>();
  Viewer viewer(*scene, {"drive", "test"}, Recorder("", 15000));
  const auto target = std::make_unique<SensorTarget>(car, viewer);
  PageReader page;
  std::size_t shown = 0;
  const auto look = [&] {
    page.catch_up(*scene);
    if (page.has_frame) {
      ASSERT_LT(shown, expected.size());
      EXPECT_FALSE(page.malformed);
      EXPECT_TRUE(std::ranges::equal(page.cells, expected[shown].cells)) << shown;
      const stream::Header& header = expected[shown].header;
      EXPECT_LE(page.points, header.points_used + header.points_other);
      EXPECT_GE(page.points, header.points_used);
      ++shown;
    }
    page.has_frame = false;
  };
  for (const CapturedDatagram& packet : drive) {
    target->take(packet, nullptr);
    look();
  }
  target->finish();
  look();
  EXPECT_EQ(shown, expected.size());
  EXPECT_NE(page.words.find(R"("state":"live")"), std::string::npos);
  EXPECT_NE(page.words.find(R"("whole":true,"damaged":false)"), std::string::npos);
}

// The classes of a target that has the same packets and poses.
TEST(SensorTarget, ShowsTheClassesOfADriveWithPoses) {
  const CatalogueEntry& car = find_vehicle("reference_car");
  Drive drive(car, 1, 1, find_scene(kDefaultScene), Motion::kContinuous);
  PoseFeed poses(simulated_poses(drive.scene(), {}, 1, 1));
  std::vector<CapturedDatagram> packets;
  for (std::uint32_t frame = 0; frame < 5; ++frame) {
    std::ranges::move(with_poses(drive.datagrams(frame), poses), std::back_inserter(packets));
  }
  const std::vector<GridFrame> expected = frames_of(car, packets);
  ASSERT_FALSE(expected.empty());
  const ClassGrid& last = *expected.back().classes;
  ASSERT_GT(std::ranges::count_if(last.cells, [](std::int8_t byte) { return byte != 0; }), 1000);

  const auto scene = std::make_unique<Scene>();
  Viewer viewer(*scene, {"drive", "test"}, Recorder("", 15000));
  const auto target = std::make_unique<SensorTarget>(car, viewer);
  for (const CapturedDatagram& packet : packets) {
    target->take(packet, nullptr);
  }
  target->finish();
  PageReader page;
  page.catch_up(*scene);
  ASSERT_TRUE(page.has_classes);
  for (std::size_t slot = 0; slot < geometry::kTileCount; ++slot) {
    const std::size_t tile = tile_in_window(last.window, slot);
    for (std::size_t i = 0; i < geometry::kTileCells; ++i) {
      ASSERT_EQ(page.classes.at(cell_of_tile(slot, i)), last.cells.at(cell_of_tile(tile, i)));
    }
  }
}

TEST(SensorTarget, TheTruthComesWithItsFrame) {
  const CatalogueEntry& car = find_vehicle("reference_car");
  const auto scene = std::make_unique<Scene>();
  Viewer viewer(*scene, {"drive", "test"}, Recorder("", 15000));
  const auto target = std::make_unique<SensorTarget>(car, viewer);
  auto truth = std::make_shared<Truth>();
  truth->occupied.resize(geometry::kCellCount);
  truth->occupied[12345] = true;
  for (const CapturedDatagram& packet : sample_drive(car, 1, 1)) {
    target->take(packet, truth);
  }
  PageReader page;
  page.catch_up(*scene);
  EXPECT_TRUE(page.has_truth);
  EXPECT_EQ(page.truth.at(12345), 1);
  EXPECT_EQ(std::ranges::count(page.truth, 1), 1);
}

}  // namespace
}  // namespace iog::tools::view
