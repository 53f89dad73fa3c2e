// Objects as an MCAP file says them.
#include "tools/formats/ros/object_messages.hpp"

#include <fstream>
#include <optional>

#include "gtest/gtest.h"

#include "fakes/temporary_folder.hpp"
#include "tools/formats/mcap/reader.hpp"
#include "tools/record/mcap_recording.hpp"
#include "wire/byte_reader.hpp"

namespace iog::tools::ros {
namespace {

using stream::ObjectRecord;
using stream::ObjectState;

ObjectRecord car(std::uint32_t id) {
  return {.id = id,
          .state = ObjectState::kMoves,
          .length_cm = 450,
          .width_cm = 180,
          .vx_cm_s = -300,
          .vy_cm_s = 400,
          .sigma_v_along_cm_s = 40,
          .sigma_v_across_cm_s = 90};
}

// 5 m/s are 18 km/h; twice 0.4 m/s are 2.88 km/h, which is not less than 3.
TEST(WordsOfAnObject, SaySpeedAndTwoDeviationsOfWhatIsBelieved) {
  EXPECT_EQ(words_of(car(7)), "7: 18 ± 3 km/h");
  ObjectRecord doubted = car(7);
  doubted.sigma_v_along_cm_s = 250;
  EXPECT_EQ(words_of(doubted), "7: moves, speed not believed");
  EXPECT_EQ(words_of({.id = 8, .state = ObjectState::kStopped}), "8: stopped");
  EXPECT_EQ(words_of({.id = 9, .state = ObjectState::kStands}), "9: stands");
  EXPECT_EQ(words_of({.id = 10}), "10: speed not believed");
}

// By hand from the definition: "odom\0" has 3 bytes behind it to align, "7\0" has 2, and
// frame_locked 3. What is in an entity tests/e2e/recordings reads by Foxglove's own reader.
TEST(SceneUpdate, BeginsAsCdrSays) {
  const std::vector objects{car(7)};
  const auto message =
      scene_update({.stamp_us = 7'000'002, .lifetime_us = 80'000, .objects = objects, .gone = {}});
  wire::ByteReader in(message);
  EXPECT_EQ(in.u32_be(), 0x00010000U) << "CDR, little endian";
  EXPECT_EQ(in.u32_le(), 0U) << "deletions";
  EXPECT_EQ(in.u32_le(), 1U) << "entities";
  EXPECT_EQ(in.u32_le(), 7U) << "seconds";
  EXPECT_EQ(in.u32_le(), 2'000U) << "nanoseconds";
  EXPECT_EQ(in.u32_le(), 5U) << "odom and its zero";
  in.skip(8);
  EXPECT_EQ(in.u32_le(), 2U) << "7 and its zero";
  in.skip(4);
  EXPECT_EQ(in.u32_le(), 0U) << "lifetime, seconds";
  EXPECT_EQ(in.u32_le(), 80'000'000U) << "lifetime, nanoseconds";
  in.skip(4);
  EXPECT_EQ(in.u32_le(), 4U) << "pairs of metadata";
  EXPECT_TRUE(in.ok());
}

std::optional<stream::ObjectList> list_of(std::initializer_list<std::uint32_t> ids) {
  stream::ObjectList list{.time_us = 5};
  for (const std::uint32_t id : ids) {
    list.records.at(list.count++) = car(id);
  }
  return list;
}

struct Named {
  std::vector<std::string> gone;
  std::uint32_t entities = 0;
  friend bool operator==(const Named&, const Named&) = default;
};

// Deletions: stamp 8, type 1 and 3 to align, id.
Named named_in(std::span<const std::byte> message) {
  wire::ByteReader in(message);
  in.skip(4);
  Named named;
  std::size_t at = 4;
  for (std::uint32_t left = in.u32_le(); left > 0; --left) {
    in.skip(12);
    const std::uint32_t letters = in.u32_le();
    const auto bytes = in.bytes(letters);
    std::string id;
    for (const std::byte letter : bytes.first(letters - 1)) {
      id += static_cast<char>(letter);
    }
    named.gone.push_back(id);
    at += 16 + letters;
    in.skip((4 - at % 4) % 4);
    at += (4 - at % 4) % 4;
  }
  named.entities = in.u32_le();
  EXPECT_TRUE(in.ok());
  return named;
}

// What is gone is said once. A frame whose list has not come, or that knows nothing because it has
// no place, says nothing, and forgets nothing.
TEST(ObjectsOfARecording, WhatIsNotNamedAgainIsTakenAway) {
  const tests::TemporaryFolder folder;
  const std::string path = folder / "objects.mcap";
  McapRecording recording(path, {std::string(kObjectsTopic)}, mcap::Compression::kNone);
  const LiveGrid live;
  const LiveClasses classes;
  GridFrame frame;
  for (const auto& list : {list_of({3, 4, 1000}), list_of({4}), std::optional<stream::ObjectList>(),
                           std::optional(stream::ObjectList{}), list_of({}), list_of({5})}) {
    frame.objects = list;
    recording.take_frame({.frame = &frame, .live = &live, .classes = &classes});
  }
  recording.finish({});
  std::ifstream in(path, std::ios::binary);
  mcap::Reader reader(in);
  std::vector<Named> named;
  while (const std::optional<mcap::Message> message = reader.next()) {
    EXPECT_EQ(reader.channels().at(message->channel_id).topic, kObjectsTopic);
    named.push_back(named_in(message->data));
  }
  const std::vector<Named> expected{{.gone = {}, .entities = 3},
                                    {.gone = {"3", "1000"}, .entities = 1},
                                    {.gone = {"4"}, .entities = 0},
                                    {.gone = {}, .entities = 1}};
  EXPECT_EQ(named, expected);
}

}  // namespace
}  // namespace iog::tools::ros
