// A grid encoded by several cores: the same messages as from one, byte for byte.
#include <array>
#include <gtest/gtest.h>
#include <memory>
#include <tuple>
#include <utility>
#include <vector>

#include "app/network_sink.hpp"
#include "app/tile_sender.hpp"
#include "fakes/random.hpp"
#include "sharing_platform.hpp"
#include "stream/class_hash.hpp"

namespace iog::app {
namespace {

using testing::Accident;
using testing::kAnyTimeUs;
using testing::kShortlyUs;
using testing::SharingPlatform;
using Message = SharingPlatform::Message;

// Tiles of a made-up drive: most stay as they were, some change a little, some all over. They are
// more than are encoded in a round.
class Drive {
 public:
  void next() {
    for (auto& tile : tiles_) {
      const int changes = random_.one_in(8) ? 1024 : random_.one_in(2) ? 5 : 0;
      for (int i = 0; i < changes; ++i) {
        tile[random_.below(tile.size())] = static_cast<std::byte>(random_.between(-14, 2));
      }
    }
  }

  template <typename AnyPlatform>
  void publish(std::uint32_t number, NetworkSink<AnyPlatform>& sink) const {
    sink.begin_frame({.frame_number = number});
    for (std::size_t i = 0; i < tiles_.size(); ++i) {
      sink.take_tile(3 * i, tiles_[i]);
    }
    sink.end_frame();
  }

 private:
  tests::Random random_{7};
  std::array<std::array<std::byte, tile_coding::kTileBytes>, 300> tiles_{};
};

template <typename AnyPlatform>
void play(int frames, AnyPlatform& platform) {
  const auto sink = std::make_unique<NetworkSink<AnyPlatform>>(platform, Coding::kShortest);
  const auto drive = std::make_unique<Drive>();
  for (int frame = 0; frame < frames; ++frame) {
    drive->next();
    drive->publish(static_cast<std::uint32_t>(frame), *sink);
  }
}

constexpr int kFrames = 20;

const std::vector<Message>& messages_of_one_core() {
  static const std::vector<Message> messages = [] {
    SharingPlatform alone(1, kAnyTimeUs);
    play(kFrames, alone);
    return alone.messages;
  }();
  return messages;
}

class PublishBy : public ::testing::TestWithParam<std::size_t> {};

TEST_P(PublishBy, CoresGivesTheMessagesOfOne) {
  SharingPlatform platform(GetParam(), kAnyTimeUs);
  play(kFrames, platform);
  EXPECT_EQ(platform.messages, messages_of_one_core());
  EXPECT_GT(platform.items_of_helpers(), 0U);
}

INSTANTIATE_TEST_SUITE_P(TwoToFour, PublishBy, ::testing::Values(2U, 3U, 4U));

class PublishDespite : public ::testing::TestWithParam<Accident> {};

TEST_P(PublishDespite, TheLossOfACoreGivesTheMessagesOfOne) {
  SharingPlatform platform(3, kShortlyUs);
  platform.let_happen(GetParam());
  play(kFrames, platform);
  EXPECT_EQ(platform.messages, messages_of_one_core());
  EXPECT_NE(platform.fate_of_victim(), work::Loss::kNone);
}

INSTANTIATE_TEST_SUITE_P(Accidents, PublishDespite,
                         ::testing::Values(Accident::kFaultBefore, Accident::kFaultAfter,
                                           Accident::kHangBefore, Accident::kHangAfter));

// Tiles of classes of a made-up drive: some have no class, more than half stay from frame to frame.
class ClassDrive {
 public:
  void next() {
    for (std::size_t i = 0; i < tiles_.size(); ++i) {
      if (random_.one_in(2)) {
        continue;
      }
      ++versions_[i];
      if (random_.one_in(9)) {
        tiles_[i].fill({});
      }
      const int changes = random_.one_in(8) ? 1024 : random_.one_in(2) ? 5 : 0;
      for (int change = 0; change < changes; ++change) {
        tiles_[i][random_.below(kTileBytes)] = static_cast<std::byte>(random_.below(48));
      }
    }
  }

  // are_told: whether a tile that stays is said to.
  void publish(std::uint32_t number, bool are_told,
               TileSender<SharingPlatform, stream::ClassHash>& sender) {
    sender.begin({.frame_number = number}, {.corner_a = -3, .corner_b = 8});
    for (std::size_t i = 0; i < tiles_.size(); ++i) {
      sender.add_classes(3 * i, tiles_[i], static_cast<std::uint8_t>(number % 5),
                         are_told ? versions_[i] : number + 1);
    }
    names_.push_back(sender.finish().crc);
  }

  [[nodiscard]] const std::vector<std::uint32_t>& names() const { return names_; }

 private:
  static constexpr std::size_t kTileBytes = tile_coding::kTileBytes;

  tests::Random random_{11};
  std::array<std::array<std::byte, kTileBytes>, 300> tiles_{};
  std::array<std::uint32_t, 300> versions_ = [] {
    std::array<std::uint32_t, 300> ones{};
    ones.fill(1);
    return ones;
  }();
  std::vector<std::uint32_t> names_;
};

// The names of the grids; the messages are the platform's.
std::vector<std::uint32_t> play_classes(int frames, bool are_told, SharingPlatform& platform) {
  MessageSender<SharingPlatform> messages(platform);
  const auto sender = std::make_unique<TileSender<SharingPlatform, stream::ClassHash>>(
      platform, messages, Coding::kShortest);
  const auto drive = std::make_unique<ClassDrive>();
  for (int frame = 0; frame < frames; ++frame) {
    drive->next();
    drive->publish(static_cast<std::uint32_t>(frame), are_told, *sender);
  }
  return drive->names();
}

struct PublishedClasses {
  std::vector<Message> messages;
  std::vector<std::uint32_t> names;
};

// Each tile is looked at in each frame.
const PublishedClasses& classes_that_are_all_new() {
  static const PublishedClasses published = [] {
    SharingPlatform alone(1, kAnyTimeUs);
    auto names = play_classes(kFrames, false, alone);
    return PublishedClasses{.messages = std::move(alone.messages), .names = std::move(names)};
  }();
  return published;
}

class PublishClassesBy : public ::testing::TestWithParam<std::size_t> {};

TEST_P(PublishClassesBy, CoresThatAreToldWhatStaysGivesTheSameMessages) {
  SharingPlatform platform(GetParam(), kAnyTimeUs);
  EXPECT_EQ(play_classes(kFrames, true, platform), classes_that_are_all_new().names);
  EXPECT_EQ(platform.messages, classes_that_are_all_new().messages);
}

INSTANTIATE_TEST_SUITE_P(OneToFour, PublishClassesBy, ::testing::Values(1U, 2U, 3U, 4U));

class PublishClassesDespite : public ::testing::TestWithParam<std::tuple<Accident, std::size_t>> {};

TEST_P(PublishClassesDespite, TheLossOfACoreGivesTheSameMessages) {
  SharingPlatform platform(3, kShortlyUs);
  const auto& [accident, round] = GetParam();
  platform.let_happen(accident, round);
  EXPECT_EQ(play_classes(kFrames, true, platform), classes_that_are_all_new().names);
  EXPECT_EQ(platform.messages, classes_that_are_all_new().messages);
  EXPECT_NE(platform.fate_of_victim(), work::Loss::kNone);
}

// In the first frame, and when much is known already.
INSTANTIATE_TEST_SUITE_P(Accidents, PublishClassesDespite,
                         ::testing::Combine(::testing::Values(Accident::kFaultBefore,
                                                              Accident::kFaultAfter),
                                            ::testing::Values(0U, 9U)));

// Does all alone, and has lost its helpers when it has been asked often enough for its cores.
class LonelyPlatform : public SharingPlatform {
 public:
  explicit LonelyPlatform(int asked_with_helpers)
      : SharingPlatform(1, kAnyTimeUs), asked_with_helpers_(asked_with_helpers) {}

  [[nodiscard]] std::size_t cores() const { return --asked_with_helpers_ >= 0 ? 3 : 1; }

 private:
  mutable int asked_with_helpers_;
};

class PublishFrom : public ::testing::TestWithParam<int> {};

TEST_P(PublishFrom, ABatchThatLosesItsHelpersGivesTheMessagesOfOne) {
  LonelyPlatform platform(GetParam());
  play(kFrames, platform);
  EXPECT_EQ(platform.messages, messages_of_one_core());
}

// Tiles that are in the batch by then: none, one, some, nearly all of a batch.
INSTANTIATE_TEST_SUITE_P(Tiles, PublishFrom, ::testing::Values(0, 1, 50, 191));

}  // namespace
}  // namespace iog::app
