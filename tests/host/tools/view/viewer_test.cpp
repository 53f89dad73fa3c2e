// What a viewer says of a picture whose stream pauses, changes or ends.
#include "tools/view/viewer.hpp"

#include <algorithm>
#include <memory>
#include <string_view>

#include "gtest/gtest.h"

#include "../drive_sample.hpp"
#include "page_reader.hpp"

namespace iog::tools::view {
namespace {

constexpr std::size_t kContent = protection::kProtectionBytes;
constexpr std::size_t kBody = kContent + stream::kHeaderBytes;
constexpr std::uint8_t kNeverCame = 255;

const Messages& sample() {
  static const Messages messages = [] {
    const CatalogueEntry& car = find_vehicle("reference_car");
    return messages_of(car, sample_drive(car, 1, 4));
  }();
  return messages;
}

bool is_end(const std::vector<std::byte>& message) {
  return message.at(kContent) == static_cast<std::byte>(stream::MessageType::kFrameEnd);
}

class ViewerTest : public testing::Test {
 protected:
  void take(std::span<const std::vector<std::byte>> messages) {
    for (const auto& message : messages) {
      viewer_.take(message);
    }
  }
  [[nodiscard]] bool says(std::string_view words) {
    page_.catch_up(*scene_);
    return page_.words.find(words) != std::string::npos;
  }

  std::unique_ptr<Scene> scene_ = std::make_unique<Scene>();
  Viewer viewer_{*scene_, {.kind = "stream", .words = "test"}, Recorder("", 15000)};
  PageReader page_;
};

// How long it was is not known: by frames they might look as if they were of a moment ago.
TEST_F(ViewerTest, AfterASilenceOldTilesHaveNoAge) {
  const auto second = std::ranges::find_if(sample(), is_end) + 1;
  take({sample().begin(), second});
  EXPECT_TRUE(says(R"("state":"live")"));
  EXPECT_EQ(std::ranges::count(page_.ages, kNeverCame), 0);
  viewer_.note_silence();
  take({second, second + 1});
  viewer_.note_silence();
  ASSERT_TRUE(says(R"("state":"live")"));
  ASSERT_TRUE(page_.has_frame);
  EXPECT_GT(std::ranges::count(page_.ages, kNeverCame), 0);
}

// Frames end, and nothing that is in them can be shown: the picture is not of now.
TEST_F(ViewerTest, AnotherGridIsIncompatibleThoughFramesEnd) {
  Messages messages = sample();
  protection::Sender sender(stream::kNetworkChannel);
  for (auto& message : messages) {
    if (!is_end(message)) {
      message[kBody + 9] = std::byte{32};  // 1,056 columns, more than any grid has
    }
    sender.protect(message);
  }
  take(messages);
  viewer_.note_silence();
  viewer_.tend();
  EXPECT_TRUE(says(R"("state":"incompatible")")) << page_.words;
}

// Half a frame would look as if the rest of the world were unknown.
TEST_F(ViewerTest, ARecordingThatEndsInMidFrameEndsAtTheLastWholeOne) {
  const auto second = std::ranges::find_if(sample(), is_end) + 1;
  take({sample().begin(), second + 1});
  ASSERT_TRUE(says(R"("number":0)"));
  viewer_.note_end();
  EXPECT_TRUE(says(R"("number":0)")) << page_.words;
  EXPECT_TRUE(says(R"("breaks_off":true)")) << page_.words;
  EXPECT_TRUE(says(R"("missing_tiles":0)")) << page_.words;
  EXPECT_TRUE(says(R"("state":"ended")"));
}

// That it has an end says that the recording goes on to there.
TEST_F(ViewerTest, ALastFrameThatLacksTilesIsShown) {
  const auto second = std::ranges::find_if(sample(), is_end) + 1;
  const auto third = std::find_if(second, sample().end(), is_end) + 1;
  take({sample().begin(), second});
  take({second + 1, third});  // without the first tiles
  viewer_.note_end();
  EXPECT_TRUE(says(R"("number":1)")) << page_.words;
  EXPECT_TRUE(says(R"("breaks_off":false)")) << page_.words;
  EXPECT_TRUE(says(R"("whole":false)")) << page_.words;
}

TEST_F(ViewerTest, ARecordingThatEndsWithAFrameDoesNotBreakOff) {
  take(sample());
  viewer_.note_end();
  EXPECT_TRUE(says(R"("breaks_off":false)")) << page_.words;
  EXPECT_TRUE(says(R"("missing_tiles":0)")) << page_.words;
}

TEST_F(ViewerTest, APageMayAskForAnotherPlaceOfARecordingOnly) {
  scene_->ask("jump 5");
  viewer_.tend();
  EXPECT_FALSE(viewer_.take_jump());
  viewer_.note_span(60'000);
  for (const char* const words :
       {"jump", "jump ", "jump x", "jump -1", "jump 1.5", "jump 99999999999999999999"}) {
    scene_->ask(words);
  }
  viewer_.tend();
  EXPECT_FALSE(viewer_.take_jump());
  scene_->ask("jump 1500");
  viewer_.tend();
  EXPECT_EQ(viewer_.take_jump(), 1500U);
  EXPECT_FALSE(viewer_.take_jump());
  scene_->ask("jump 60001");
  viewer_.tend();
  EXPECT_EQ(viewer_.take_jump(), 60'000U);
}

// What is played from another place has the run and the frames that it had before.
TEST_F(ViewerTest, ARecordingIsPlayedAgainAfterItsEnd) {
  take(sample());
  viewer_.note_end();
  viewer_.begin_again();
  const auto second = std::ranges::find_if(sample(), is_end) + 1;
  take({sample().begin(), second});
  EXPECT_TRUE(says(R"("number":0)")) << page_.words;
  EXPECT_TRUE(says(R"("state":"live")"));
}

}  // namespace
}  // namespace iog::tools::view
