#include "tools/view/sensor_target.hpp"

#include <memory>

#include "gtest/gtest.h"

#include "../drive_sample.hpp"
#include "page_reader.hpp"

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
    target->take(packet, {});
    look();
  }
  target->finish();
  look();
  EXPECT_EQ(shown, expected.size());
  EXPECT_NE(page.words.find(R"("state":"live")"), std::string::npos);
  EXPECT_NE(page.words.find(R"("whole":true,"damaged":false)"), std::string::npos);
}

TEST(SensorTarget, TheTruthComesWithItsFrame) {
  const CatalogueEntry& car = find_vehicle("reference_car");
  const auto scene = std::make_unique<Scene>();
  Viewer viewer(*scene, {"drive", "test"}, Recorder("", 15000));
  const auto target = std::make_unique<SensorTarget>(car, viewer);
  std::vector<bool> truth(geometry::kCellCount, false);
  truth[12345] = true;
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
