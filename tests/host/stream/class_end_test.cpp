// The message that ends a frame's classes, byte by byte as docs/spec.md 3.10 lists it.
#include "stream/class_end.hpp"

#include <gtest/gtest.h>
#include <string>
#include <vector>

#include "fakes/bytes_of.hpp"
#include "protection/protected_message.hpp"

namespace iog::stream {
namespace {

using tests::bytes_of;
using Bytes = std::vector<std::byte>;

ClassEnd some_end() {
  ClassEnd end{.window = {.causes = kCauseJump, .corner_a = -17, .corner_b = 3, .slices = 2},
               .tiles_sent = 0x01020304,
               .tiles_lost = 2,
               .classes_crc = 0xA1A2A3A4,
               .packets_placed = 20,
               .packets_not_placed = 4,
               .slices_over_budget = 1,
               .groups_fused = 30'000,
               .groups_left = 7,
               .groups_refreshed = 9};
  end.slice_count = 2;
  end.slices[0] = {.middle_us = 0x1112131415161718,
                   .pose = {.x_mm = -2, .y_mm = 5, .heading = 0x80000001},
                   .sigma = {.position_mm = 10, .heading_10urad = 20}};
  end.slices[1].middle_us = 8000;
  end.slices[1].sigma = {.position_mm = 1, .heading_10urad = 1};
  end.pose_fates[0] = 50;
  end.pose_fates[pose::kFateCount - 1] = 6;
  end.causes[1] = {.slices = 3, .began = {.times = 2, .since_us = 0x2122232425262728}};
  MapState& map = end.map;
  map.in_use.emplace().source = 1;
  map.in_use->set_words("me");
  map.layer = {.cause = map::Cause::kOtherOrigin,
               .crc = 0xB1B2B3B4,
               .origin = 0x3132333435363738,
               .transform = pose::MapTransform{.origin = 0x4142434445464748,
                                               .local_frame = {-2, 5, 0x80000001},
                                               .sigma = {10, 20}},
               .radius = 9,
               .tiles_drawn = 1,
               .tiles_outside = 2,
               .tiles_waiting = 0x0304};
  map.layer.begun[1] = 6;
  map.delivery = {.state = map::DeliveryState::kReceiving,
                  .incoming = {.crc = 0xC1C2C3C4, .bytes = 3'000},
                  .chunks_there = 2,
                  .fates = {5},
                  .blocks_refused = 1,
                  .last_refusal = map::Refusal::kDamaged};
  map.delivery.fates.back() = 7;
  return end;
}

// What the target says of its map, at the offsets of docs/spec.md.
Bytes some_map() {
  Bytes part = bytes_of({
      0,    158,  3,    9,    0,    1,    0,    2,    3,    4,    3,    1,  // cause ... source
      0xB1, 0xB2, 0xB3, 0xB4, 0x31, 0x32, 0x33, 0x34, 0x35, 0x36, 0x37, 0x38, 0x41, 0x42,
      0x43, 0x44, 0x45, 0x46, 0x47, 0x48, 0xFF, 0xFF, 0xFF, 0xFE, 0,    0,    0,    5,
      0x80, 0,    0,    1,    0,    10,   0,    20,   1,    6,    9,    12,   0,    0,
      0,    1,    0xC1, 0xC2, 0xC3, 0xC4, 0,    0,    0x0B, 0xB8, 0,    0,    0,    2,
      2,    0,    0,    0,    0,    0,    0,    0,    0,    0,    0,    6,
  });
  part.resize(72 + 9 * 4);
  part.resize(part.size() + 12 * 4);
  part[72 + 9 * 4 + 3] = std::byte{5};
  part[72 + 20 * 4 + 3] = std::byte{7};
  part.push_back(std::byte{'m'});
  part.push_back(std::byte{'e'});
  return part;
}

// What follows the window's header.
Bytes some_rest() {
  Bytes rest = bytes_of({
      1,  2, 3,    4,    0,  0, 0, 2, 0xA1, 0xA2, 0xA3, 0xA4,  // tiles, name
      0,  0, 0,    20,   0,  0, 0, 4, 0,    0,    0,    1,     // packets, slices over budget
      0,  0, 0x75, 0x30, 0,  0, 0, 7, 0,    0,    0,    9,     // groups
      16, 8, 16,   2,    24, 0, 0, 0,                          // counts and lengths
  });
  const auto append = [&](const Bytes& bytes) {
    rest.insert(rest.end(), bytes.begin(), bytes.end());
  };
  append(bytes_of({0, 0, 0, 50}));
  append(Bytes(14 * 4));
  append(bytes_of({0, 0, 0, 6}));
  append(Bytes(16));
  append(bytes_of({0, 0, 0, 3, 0, 0, 0, 2, 0x21, 0x22, 0x23, 0x24, 0x25, 0x26, 0x27, 0x28}));
  append(Bytes(6 * 16));
  append(bytes_of({0x11, 0x12, 0x13, 0x14, 0x15, 0x16, 0x17, 0x18, 0xFF, 0xFF, 0xFF, 0xFE,
                   0,    0,    0,    5,    0x80, 0,    0,    1,    0,    10,   0,    20}));
  append(bytes_of({0, 0, 0, 0, 0, 0, 0x1F, 0x40, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 1, 0, 1}));
  return rest;
}

Bytes some_body_before_the_map() {
  Bytes body(kClassWindowBytes);
  write_class_window(some_end().window, std::span(body).first<kClassWindowBytes>());
  const Bytes rest = some_rest();
  body.insert(body.end(), rest.begin(), rest.end());
  return body;
}

Bytes with_map(Bytes body) {
  const Bytes map = some_map();
  body.insert(body.end(), map.begin(), map.end());
  return body;
}

Bytes some_body() { return with_map(some_body_before_the_map()); }

TEST(ClassEnd, IsWrittenAsTheSpecificationSays) {
  Bytes buffer(2000);
  const std::size_t bytes = write_class_end(some_end(), buffer);
  buffer.resize(bytes);
  EXPECT_EQ(buffer, some_body());
}

TEST(ClassEnd, OfTheMapIsReadAsTheSpecificationSays) {
  ClassEnd end;
  ASSERT_EQ(read_class_end(some_body(), end), ReadStatus::kOk);
  const MapState expected = some_end().map;
  EXPECT_EQ(end.map.in_use, expected.in_use);
  EXPECT_EQ(end.map.in_use->words(), "me");
  EXPECT_EQ(end.map.layer.cause, map::Cause::kOtherOrigin);
  EXPECT_EQ(end.map.layer.begun, expected.layer.begun);
  EXPECT_EQ(end.map.layer.crc, 0xB1B2B3B4U);
  EXPECT_EQ(end.map.layer.origin, 0x3132333435363738U);
  EXPECT_EQ(end.map.layer.transform, expected.layer.transform);
  EXPECT_EQ(end.map.layer.radius, 9);
  EXPECT_EQ(end.map.layer.tiles_drawn, 1);
  EXPECT_EQ(end.map.layer.tiles_outside, 2);
  EXPECT_EQ(end.map.layer.tiles_waiting, 0x0304);
  EXPECT_EQ(end.map.delivery.state, map::DeliveryState::kReceiving);
  EXPECT_EQ(end.map.delivery.incoming, expected.delivery.incoming);
  EXPECT_EQ(end.map.delivery.chunks_there, 2U);
  EXPECT_EQ(end.map.delivery.blocks_refused, 1U);
  EXPECT_EQ(end.map.delivery.last_refusal, map::Refusal::kDamaged);
  EXPECT_EQ(end.map.delivery.fates, expected.delivery.fates);
}

// Another count, and a field behind the attribution.
TEST(ClassEnd, WhatALaterVersionSaysOfTheMapIsSkipped) {
  Bytes body = some_body();
  const std::size_t at = body.size() - some_map().size();
  body[at + 1] = std::byte{158 + 6};
  body[at + 51] = std::byte{13};
  body.insert(body.begin() + static_cast<std::ptrdiff_t>(at) + 72 + 21 * 4, 4, std::byte{0xEE});
  body.insert(body.end(), 2, std::byte{0xEE});
  ClassEnd end;
  ASSERT_EQ(read_class_end(body, end), ReadStatus::kOk);
  EXPECT_EQ(end.map.delivery.fates, some_end().map.delivery.fates);
  EXPECT_EQ(end.map.in_use->words(), "me");
}

// UTF-8 of two bytes a character: 95 bytes and half a character are 95.
TEST(ClassEnd, AnAttributionIsCutAtACharacter) {
  MapInUse in_use;
  std::string text(95, 'a');
  in_use.set_words(text + "\xC3\xA9t\xC3\xA9");
  EXPECT_EQ(in_use.words(), text);
  in_use.set_words(text + "b");
  EXPECT_EQ(in_use.words(), text + "b");
  in_use.set_words("\xC2\xA9 me");
  EXPECT_EQ(in_use.words(), "\xC2\xA9 me");
}

TEST(ClassEnd, IsReadAsTheSpecificationSays) {
  ClassEnd end;
  ASSERT_EQ(read_class_end(some_body(), end), ReadStatus::kOk);
  const ClassEnd expected = some_end();
  EXPECT_EQ(end.window, expected.window);
  EXPECT_EQ(end.tiles_sent, 0x01020304U);
  EXPECT_EQ(end.tiles_lost, 2U);
  EXPECT_EQ(end.classes_crc, 0xA1A2A3A4U);
  EXPECT_EQ(end.packets_placed, 20U);
  EXPECT_EQ(end.packets_not_placed, 4U);
  EXPECT_EQ(end.slices_over_budget, 1U);
  EXPECT_EQ(end.groups_fused, 30'000U);
  EXPECT_EQ(end.groups_left, 7U);
  EXPECT_EQ(end.groups_refreshed, 9U);
  EXPECT_EQ(end.slice_count, 2);
  EXPECT_EQ(end.slices, expected.slices);
  EXPECT_EQ(end.pose_fates, expected.pose_fates);
  EXPECT_EQ(end.causes[1].slices, 3U);
  EXPECT_EQ(end.causes[1].began.times, 2U);
  EXPECT_EQ(end.causes[1].began.since_us, 0x2122232425262728U);
}

TEST(ClassEnd, FitsAMessageWithAllSlices) {
  ClassEnd end;
  end.slice_count = kMaxSlices;
  end.map.in_use.emplace().set_words(std::string(1'024, 'a'));
  std::array<std::byte, protection::kMaxMessageBytes - protection::kProtectionBytes - kHeaderBytes>
      room{};
  EXPECT_GT(write_class_end(end, room), 0U);
}

TEST(ClassEnd, NeedsRoom) {
  const std::size_t bytes = some_body().size();
  Bytes buffer(bytes);
  EXPECT_EQ(write_class_end(some_end(), buffer), bytes);
  for (std::size_t room = 0; room < bytes; ++room) {
    ASSERT_EQ(write_class_end(some_end(), std::span(buffer).first(room)), 0U) << room;
  }
}

TEST(ClassEnd, ACutOneIsTooShort) {
  const Bytes body = some_body();
  for (std::size_t bytes = 0; bytes < body.size(); ++bytes) {
    ClassEnd end;
    ASSERT_EQ(read_class_end(std::span(body).first(bytes), end), ReadStatus::kTooShort) << bytes;
  }
}

TEST(ClassEnd, ShorterRecordsThanOursContradictIt) {
  constexpr std::size_t kCauseBytes = kClassWindowBytes + 38;
  constexpr std::size_t kSliceBytes = kClassWindowBytes + 40;
  for (const std::size_t at : {kCauseBytes, kSliceBytes}) {
    Bytes body = some_body();
    body[at] = std::byte{15};
    ClassEnd end;
    EXPECT_EQ(read_class_end(body, end), ReadStatus::kInconsistent) << at;
  }
}

// A later version counts more fates, and says more of each slice.
TEST(ClassEnd, WhatALaterVersionSaysIsSkipped) {
  Bytes body = some_body_before_the_map();
  const auto counts = body.begin() + kClassWindowBytes + 36;
  counts[0] = std::byte{17};
  counts[4] = std::byte{26};
  constexpr std::size_t kFates = kClassWindowBytes + 44;
  body.insert(body.end(), 2, std::byte{0xEE});                      // of the second slice
  body.insert(body.end() - 26, 2, std::byte{0xEE});                 // of the first
  body.insert(body.begin() + kFates + 16 * 4, 4, std::byte{0xEE});  // a fate
  ClassEnd end;
  ASSERT_EQ(read_class_end(with_map(body), end), ReadStatus::kOk);
  EXPECT_EQ(end.pose_fates, some_end().pose_fates);
  EXPECT_EQ(end.slices, some_end().slices);
}

TEST(ClassEnd, MoreSlicesThanOursAreSkipped) {
  Bytes body = some_body_before_the_map();
  body[kClassWindowBytes + 39] = std::byte{kMaxSlices + 1};
  body.resize(body.size() + (kMaxSlices - 1) * 24);
  ClassEnd end;
  ASSERT_EQ(read_class_end(with_map(body), end), ReadStatus::kOk);
  EXPECT_EQ(end.slice_count, kMaxSlices);
  EXPECT_EQ(end.slices[1].middle_us, 8000U);
}

}  // namespace
}  // namespace iog::stream
