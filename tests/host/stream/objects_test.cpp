// The messages of objects, byte by byte as docs/spec.md 3.12 lists them, and what a receiver must
// not believe.
#include "stream/objects.hpp"

#include <gtest/gtest.h>

#include "fakes/bytes_of.hpp"
#include "protection/protected_message.hpp"

namespace iog::stream {
namespace {

using tests::Bytes;
using tests::bytes_of;
using tests::joined;

constexpr std::size_t kHeadBytes = 24;
constexpr std::size_t kRecordBytes = 40;

// Offsets in a part, and in one of its objects.
enum At : std::size_t { kHead = 1, kSize = 3, kObjects = 5, kPart = 6, kParts = 7 };
enum OfObject : std::size_t { kId = 3, kState = 4, kVelocityX = 25, kAlong = 28, kAcross = 30 };

// A car that comes, and something.
ObjectList some_list() {
  ObjectList list{.time_us = 0x1112131415161718, .tracks_refused = 0x2122, .hits_left = 0x3132};
  list.count = 2;
  list.records[0] = {.id = 0x41424344,
                     .state = ObjectState::kMoves,
                     .existence = 212,
                     .age_frames = 0x0102,
                     .x_mm = -2,
                     .y_mm = 0x01020304,
                     .length_cm = 0x0190,
                     .width_cm = 0x00B4,
                     .heading = 0xC001,
                     .flags = kObjectHasHeading | kObjectEndHidden,
                     .vx_cm_s = -3,
                     .vy_cm_s = 0x0203,
                     .sigma_v_along_cm_s = 0x5152,
                     .sigma_v_across_cm_s = 0x5354,
                     .sigma_along_mm = 0x6162,
                     .sigma_across_mm = 0x6364,
                     .since_hit_ms = 0x7172,
                     .since_stopped_10ms = 0x7374};
  list.records[1] = {.id = 0x41424345, .flags = kObjectNotHit};
  return list;
}

Bytes some_bytes() {
  return bytes_of({
      0,    24,   0,    40,   0,    2,    0,    1,     // of the header, of an object; objects, part
      0x11, 0x12, 0x13, 0x14, 0x15, 0x16, 0x17, 0x18,  // time
      0x21, 0x22, 0x31, 0x32, 0,    0,    0,    0,     // refused, left
      0x41, 0x42, 0x43, 0x44, 3,    212,  1,    2,     // id, class, existence, age
      0xFF, 0xFF, 0xFF, 0xFE, 1,    2,    3,    4,     // middle
      0x01, 0x90, 0x00, 0xB4, 0xC0, 0x01, 0,    5,     // box, heading, flags
      0xFF, 0xFD, 2,    3,    0x51, 0x52, 0x53, 0x54,  // velocity, deviations
      0x61, 0x62, 0x63, 0x64, 0x71, 0x72, 0x73, 0x74,  // of the place; since when
      0x41, 0x42, 0x43, 0x45, 1,    0,    0,    0,     // the other
      0,    0,    0,    0,    0,    0,    0,    0,    0, 0, 0,    0,  //
      0,    0,    0,    2,    0,    0,    0,    0,                    // flags
      0xFF, 0xFF, 0xFF, 0xFF, 0,    0,    0,    0,    0, 0, 0xFF, 0xFF,
  });
}

// As many objects, ids 1, 2, ...
ObjectList list_of(std::uint16_t count) {
  ObjectList list{.time_us = 1, .count = count};
  for (std::uint16_t i = 0; i < count; ++i) {
    list.records[i].id = i + std::uint32_t{1};
  }
  return list;
}

Bytes part_of(const ObjectList& list, std::size_t part) {
  Bytes buffer(2000);
  buffer.resize(write_objects(list, part, buffer));
  return buffer;
}

ReadStatus status_of(const Bytes& bytes) {
  ObjectPart part;
  return read_objects(bytes, part);
}

// The bytes with one of them changed.
Bytes with(Bytes bytes, std::size_t at, int value) {
  bytes.at(at) = static_cast<std::byte>(value);
  return bytes;
}

std::size_t of_object(std::size_t number, std::size_t at) {
  return kHeadBytes + number * kRecordBytes + at;
}

TEST(Objects, AreWrittenAsTheSpecificationSays) {
  EXPECT_EQ(part_of(some_list(), 0), some_bytes());
}

TEST(Objects, AreReadAsTheSpecificationSays) {
  ObjectPart part;
  ASSERT_EQ(read_objects(some_bytes(), part), ReadStatus::kOk);
  EXPECT_EQ(part.header, (ObjectsHeader{.time_us = 0x1112131415161718,
                                        .objects = 2,
                                        .parts = 1,
                                        .tracks_refused = 0x2122,
                                        .hits_left = 0x3132}));
  EXPECT_EQ(part.part, 0);
  ASSERT_EQ(part.count, 2);
  EXPECT_EQ(part.records[0], some_list().records[0]);
  EXPECT_EQ(part.records[1], some_list().records[1]);
  EXPECT_TRUE(part.records[0].is_believed());
  EXPECT_FALSE(part.records[1].is_believed());
}

TEST(Objects, OfNothingAreOneMessage) {
  EXPECT_EQ(parts_of({}), 1U);
  const Bytes nothing =
      bytes_of({0, 24, 0, 40, 0, 0, 0, 1, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0});
  EXPECT_EQ(part_of({}, 0), nothing);
  ObjectPart part;
  ASSERT_EQ(read_objects(nothing, part), ReadStatus::kOk);
  EXPECT_EQ(part.count, 0);
}

// 28 bytes of SOME/IP and E2E, 48 of the header, 24 and 32 times 40: 1380 of 1392.
TEST(Objects, GoInMessagesOf32) {
  for (const auto& [count, parts] : {std::pair{1, 1}, {32, 1}, {33, 2}, {64, 2}, {256, 8}}) {
    EXPECT_EQ(parts_of(list_of(static_cast<std::uint16_t>(count))), static_cast<std::size_t>(parts))
        << count;
  }
  const ObjectList list = list_of(256);
  std::uint32_t id = 0;
  for (std::size_t number = 0; number < 8; ++number) {
    const Bytes bytes = part_of(list, number);
    ASSERT_EQ(bytes.size(), 24U + 32 * 40);
    EXPECT_LE(protection::kProtectionBytes + kHeaderBytes + bytes.size(),
              protection::kMaxMessageBytes);
    ObjectPart part;
    ASSERT_EQ(read_objects(bytes, part), ReadStatus::kOk);
    EXPECT_EQ(part.part, number);
    EXPECT_EQ(part.header.parts, 8);
    EXPECT_EQ(part.header.objects, 256);
    ASSERT_EQ(part.count, 32);
    for (const ObjectRecord& object : part.all()) {
      EXPECT_EQ(object.id, ++id);
    }
  }
  ObjectPart last;
  ASSERT_EQ(read_objects(part_of(list_of(33), 1), last), ReadStatus::kOk);
  EXPECT_EQ(last.count, 1);
}

TEST(Objects, NeedRoom) {
  const Bytes whole = some_bytes();
  for (std::size_t room = 0; room < whole.size(); ++room) {
    Bytes buffer(room);
    ASSERT_EQ(write_objects(some_list(), 0, buffer), 0U) << room;
  }
}

TEST(Objects, CutOnesAreRefused) {
  const Bytes whole = some_bytes();
  for (std::size_t bytes = 0; bytes < whole.size(); ++bytes) {
    ASSERT_EQ(status_of({whole.begin(), whole.begin() + static_cast<std::ptrdiff_t>(bytes)}),
              bytes < kHeadBytes ? ReadStatus::kTooShort : ReadStatus::kInconsistent)
        << bytes;
  }
  ASSERT_EQ(status_of(joined({whole, bytes_of({0})})), ReadStatus::kInconsistent);
}

TEST(Objects, WhatALaterVersionSaysIsSkipped) {
  const Bytes whole = some_bytes();
  const auto at = [&](std::size_t byte) {
    return whole.begin() + static_cast<std::ptrdiff_t>(byte);
  };
  const Bytes more = bytes_of({0xEE, 0xEE, 0xEE});
  const Bytes later = with(with(joined({{at(0), at(kHeadBytes)},
                                        more,
                                        {at(kHeadBytes), at(kHeadBytes + kRecordBytes)},
                                        more,
                                        {at(kHeadBytes + kRecordBytes), whole.end()},
                                        more}),
                                kHead, 27),
                           kSize, 43);
  ObjectPart part;
  ASSERT_EQ(read_objects(later, part), ReadStatus::kOk);
  ASSERT_EQ(part.count, 2);
  EXPECT_EQ(part.records[0], some_list().records[0]);
  EXPECT_EQ(part.records[1], some_list().records[1]);
}

TEST(Objects, OtherSizesAreRefused) {
  for (const int bytes : {0, 23, 25, 64}) {
    EXPECT_EQ(status_of(with(some_bytes(), kHead, bytes)), ReadStatus::kInconsistent) << bytes;
  }
  EXPECT_EQ(status_of(with(some_bytes(), kHead, 105)), ReadStatus::kTooShort);
  for (const int bytes : {0, 20, 39, 41, 80}) {
    EXPECT_EQ(status_of(with(some_bytes(), kSize, bytes)), ReadStatus::kInconsistent) << bytes;
  }
}

TEST(Objects, CountsThatContradictAreRefused) {
  for (const int objects : {0, 1, 3, 33}) {
    EXPECT_EQ(status_of(with(some_bytes(), kObjects, objects)), ReadStatus::kInconsistent)
        << objects;
  }
  for (const int part : {1, 255}) {
    EXPECT_EQ(status_of(with(some_bytes(), kPart, part)), ReadStatus::kInconsistent) << part;
  }
  for (const int parts : {0, 2, 9, 255}) {
    EXPECT_EQ(status_of(with(some_bytes(), kParts, parts)), ReadStatus::kInconsistent) << parts;
  }
  // One of two parts with 2 of 34 objects: the other has room for 32.
  const Bytes one_of_two = with(with(some_bytes(), kParts, 2), kObjects, 34);
  EXPECT_EQ(status_of(one_of_two), ReadStatus::kOk);
  EXPECT_EQ(status_of(with(one_of_two, kPart, 1)), ReadStatus::kOk);
  EXPECT_EQ(status_of(with(one_of_two, kPart, 2)), ReadStatus::kInconsistent);
  EXPECT_EQ(status_of(with(one_of_two, kObjects, 35)), ReadStatus::kInconsistent);
  EXPECT_EQ(status_of(with(one_of_two, kObjects, 2)), ReadStatus::kInconsistent);
  EXPECT_EQ(status_of(with(one_of_two, kObjects - 1, 1)), ReadStatus::kInconsistent);
  // A part of 33 objects.
  Bytes too_many = with(part_of(list_of(32), 0), kObjects, 33);
  too_many.resize(too_many.size() + kRecordBytes);
  EXPECT_EQ(status_of(too_many), ReadStatus::kInconsistent);
  // An empty part of many.
  EXPECT_EQ(status_of(with(with(part_of(list_of(0), 0), kParts, 2), kObjects, 3)),
            ReadStatus::kInconsistent);
}

// Nothing is known then, so there is nothing to say.
TEST(Objects, WithoutATimeAreRefused) {
  ObjectList list = list_of(1);
  list.time_us = 0;
  EXPECT_EQ(status_of(part_of(list, 0)), ReadStatus::kInconsistent);
}

TEST(Objects, IdsRise) {
  for (const int id : {0x43, 0x44}) {
    EXPECT_EQ(status_of(with(some_bytes(), of_object(1, kId), id)), ReadStatus::kInconsistent)
        << id;
  }
  Bytes zero = part_of(list_of(1), 0);
  ASSERT_EQ(status_of(zero), ReadStatus::kOk);
  EXPECT_EQ(status_of(with(zero, of_object(0, kId), 0)), ReadStatus::kInconsistent);
}

TEST(Objects, UnknownStatesAreRefused) {
  for (const int value : {0, 5, 255}) {
    EXPECT_EQ(status_of(with(some_bytes(), of_object(0, kState), value)), ReadStatus::kInconsistent)
        << value;
  }
}

// Nobody gets the velocity of what is not believed to move.
TEST(Objects, SpeedsOfWhatDoesNotMoveAreRefused) {
  for (const int other : {1, 2, 4}) {
    EXPECT_EQ(status_of(with(some_bytes(), of_object(0, kState), other)), ReadStatus::kInconsistent)
        << other;
  }
  EXPECT_EQ(status_of(with(some_bytes(), of_object(1, kVelocityX), 1)), ReadStatus::kInconsistent);
  for (const std::size_t deviation : {kAlong, kAcross}) {
    EXPECT_EQ(status_of(with(some_bytes(), of_object(1, deviation), 0)), ReadStatus::kInconsistent);
    const Bytes half = with(some_bytes(), of_object(0, deviation), 0xFF);
    EXPECT_EQ(status_of(half), ReadStatus::kOk);
    EXPECT_EQ(status_of(with(half, of_object(0, deviation) + 1, 0xFF)), ReadStatus::kInconsistent);
  }
}

// What has stopped has no speed, and that is believed; what is young has none that is.
TEST(Objects, OfEachStateAreRead) {
  ObjectList list = list_of(4);
  list.records[1].state = ObjectState::kStands;
  list.records[2].state = ObjectState::kMoves;
  list.records[3].state = ObjectState::kStopped;
  for (const std::size_t believed : {2U, 3U}) {
    list.records[believed].sigma_v_along_cm_s = 0;
    list.records[believed].sigma_v_across_cm_s = 65534;
  }
  ObjectPart part;
  ASSERT_EQ(read_objects(part_of(list, 0), part), ReadStatus::kOk);
  for (std::size_t i = 0; i < 4; ++i) {
    EXPECT_EQ(part.records[i], list.records[i]) << i;
  }
}

}  // namespace
}  // namespace iog::stream
