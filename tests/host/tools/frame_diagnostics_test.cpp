// What is OK of a frame, and what is not (docs/recordings.md).
#include "tools/record/frame_diagnostics.hpp"

#include <algorithm>
#include <gtest/gtest.h>
#include <string_view>

#include "hal/thermometer.hpp"
#include "tools/vehicles/vehicle_catalogue.hpp"

namespace iog::tools {
namespace {

using intake::SensorState;
using ros::Diagnostic;
using ros::DiagnosticLevel;

// A whole frame of the reference car, whose four sensors took part; it has neither tiles nor
// classes.
GridFrame sound_frame() {
  GridFrame frame;
  frame.header.vehicle_id = find_vehicle("reference_car").vehicle->id;
  frame.header.sensor_count = 4;
  frame.has_end = true;
  frame.valid_tiles.set();
  for (intake::SensorReport& sensor : frame.end.sensors) {
    sensor = {.state = SensorState::kComplete, .age_frames = 0, .packets = 3, .points = 700};
  }
  return frame;
}

Diagnostic found_in(const GridFrame& frame, std::string_view name) {
  const auto all = diagnostics_of(frame);
  const auto found = std::ranges::find(all, name, &Diagnostic::name);
  EXPECT_NE(found, all.end()) << name;
  return found == all.end() ? Diagnostic{} : *found;
}

TEST(FrameDiagnostics, OfASoundFrameAreAllOk) {
  for (const Diagnostic& each : diagnostics_of(sound_frame())) {
    EXPECT_EQ(each.level, DiagnosticLevel::kOk) << each.name << ": " << each.message;
  }
}

// The reference car's frames are 40 ms long, and a unit of 5 Hz takes 200.
TEST(FrameDiagnostics, ASensorIsLostWhenItHasBeenSilentForMoreThanASlowTurn) {
  GridFrame frame = sound_frame();
  for (const auto& [state, age, level] :
       {std::tuple{SensorState::kPartial, 0, DiagnosticLevel::kOk},
        std::tuple{SensorState::kSilent, 5, DiagnosticLevel::kOk},
        std::tuple{SensorState::kSilent, 6, DiagnosticLevel::kError},
        std::tuple{SensorState::kNeverSeen, 0xFFFF, DiagnosticLevel::kError}}) {
    frame.end.sensors[2].state = state;
    frame.end.sensors[2].age_frames = static_cast<std::uint16_t>(age);
    EXPECT_EQ(found_in(frame, "sensor front_right").level, level) << age;
    EXPECT_EQ(found_in(frame, "sensor front_left").level, DiagnosticLevel::kOk);
  }
}

TEST(FrameDiagnostics, OfACarThatNobodyKnowsHaveNumbersForNames) {
  GridFrame frame = sound_frame();
  frame.header.vehicle_id ^= 1;
  EXPECT_EQ(found_in(frame, "sensor 3").message, "complete");
}

TEST(FrameDiagnostics, WhatNobodyWatchesIsAWarning) {
  GridFrame frame = sound_frame();
  frame.end.unwatched = 0;
  EXPECT_EQ(found_in(frame, "surroundings").level, DiagnosticLevel::kOk);
  frame.end.unwatched = 1;
  EXPECT_EQ(found_in(frame, "surroundings").level, DiagnosticLevel::kWarn);
  EXPECT_EQ(found_in(frame, "surroundings").message, "not watched: 0 to 6 degrees");
  frame.end.unwatched = ~std::uint64_t{0};
  EXPECT_EQ(found_in(frame, "surroundings").level, DiagnosticLevel::kError);
}

// 95 degrees are what the i.MX6Q's commercial grade may have.
TEST(FrameDiagnostics, AWarmChipIsAWarningAndAHotOneAnError) {
  GridFrame frame = sound_frame();
  const auto has_chip = [&] {
    const auto all = diagnostics_of(frame);
    return std::ranges::any_of(all, [](const auto& each) { return each.name == "chip"; });
  };
  ASSERT_EQ(frame.end.temperature_dc, hal::kTemperatureNotKnown);
  EXPECT_FALSE(has_chip());
  for (const auto& [dc, level, words] :
       {std::tuple{-55, DiagnosticLevel::kOk, "-5.5 degrees Celsius"},
        std::tuple{849, DiagnosticLevel::kOk, "84.9 degrees Celsius"},
        std::tuple{850, DiagnosticLevel::kWarn, "warm: 85.0 degrees Celsius"},
        std::tuple{949, DiagnosticLevel::kWarn, "warm: 94.9 degrees Celsius"},
        std::tuple{950, DiagnosticLevel::kError, "too hot: 95.0 degrees Celsius"}}) {
    frame.end.temperature_dc = static_cast<std::int16_t>(dc);
    EXPECT_EQ(found_in(frame, "chip").level, level) << dc;
    EXPECT_EQ(found_in(frame, "chip").message, words);
  }
}

TEST(FrameDiagnostics, ABlockedSensorIsAnErrorAndAPartAWarning) {
  GridFrame frame = sound_frame();
  frame.end.unwatched = frame.end.blocked = 1;
  frame.end.sensors[2].blocked = intake::Blocked::kPartly;
  EXPECT_EQ(found_in(frame, "sensor front_right").level, DiagnosticLevel::kWarn);
  EXPECT_EQ(found_in(frame, "sensor front_right").message, "complete, partly blocked");
  EXPECT_EQ(found_in(frame, "surroundings").values.at(1).second, "0 to 6 degrees");
  frame.end.sensors[2].blocked = intake::Blocked::kWhole;
  EXPECT_EQ(found_in(frame, "sensor front_right").level, DiagnosticLevel::kError);
  EXPECT_EQ(found_in(frame, "sensor front_right").message, "complete, blocked");
}

TEST(FrameDiagnostics, MissingMessagesAreAWarningAndDamageIsAnError) {
  GridFrame frame = sound_frame();
  frame.valid_tiles.reset(5);
  EXPECT_EQ(found_in(frame, "stream").level, DiagnosticLevel::kWarn);
  frame.is_damaged = true;
  EXPECT_EQ(found_in(frame, "stream").level, DiagnosticLevel::kError);
  frame = sound_frame();
  frame.header.flags |= stream::kFlagObjects;
  EXPECT_EQ(found_in(frame, "stream").level, DiagnosticLevel::kWarn) << "its list is missing";
}

TEST(FrameDiagnostics, PointsThatATargetHadNoTimeForAreAnError) {
  GridFrame frame = sound_frame();
  frame.end.fates[static_cast<std::size_t>(vehicle::Fate::kUsed)] = 12;
  frame.end.fates[static_cast<std::size_t>(vehicle::Fate::kNotTaken)] = 7;
  const Diagnostic points = found_in(frame, "points");
  EXPECT_EQ(points.level, DiagnosticLevel::kError);
  EXPECT_EQ(points.message, "the target is too slow: 7 not taken");
  const decltype(points.values) expected{{"used", "12"}, {"not taken", "7"}};
  EXPECT_EQ(points.values, expected);
}

// docs/spec.md 3.9: with 0x02, 0x08, 0x10 and 0x40 what was known has lost its place.
TEST(FrameDiagnostics, PosesThatMakeTheWindowUnknownAreErrors) {
  GridFrame frame = sound_frame();
  frame.classes.emplace();
  frame.classes->has_end = true;
  for (unsigned bit = 0; bit < 8; ++bit) {
    frame.classes->window.causes = static_cast<std::uint16_t>(1U << bit);
    const bool is_unknown = (0xDAU >> bit & 1U) != 0;
    EXPECT_EQ(found_in(frame, "poses").level,
              is_unknown ? DiagnosticLevel::kError : DiagnosticLevel::kWarn)
        << bit;
  }
  frame.classes->window.causes = 0xC1;
  EXPECT_EQ(found_in(frame, "poses").message, "late, contradicted, drifting");
}

TEST(FrameDiagnostics, OfAFrameWithoutItsEndSayNothingOfSensors) {
  GridFrame frame = sound_frame();
  frame.has_end = false;
  const auto all = diagnostics_of(frame);
  ASSERT_EQ(all.size(), 1U);
  EXPECT_EQ(all.front().message, "messages are missing");
}

// Behind 42 counters of the network come the cores', and 10 further on the run before
// (docs/spec.md 3.7).
TEST(FrameDiagnostics, ATargetThatStartedAgainOrLostACoreIsAWarning) {
  GridFrame frame = sound_frame();
  frame.end.link_counter_count = 55;
  frame.end.link_counters[stream::place_of("cores at work")] = 4;
  frame.end.link_counters[stream::place_of("starts since power-up")] = 1;
  EXPECT_EQ(found_in(frame, "cores").level, DiagnosticLevel::kOk);
  EXPECT_EQ(found_in(frame, "starts").level, DiagnosticLevel::kOk);
  frame.end.link_counters[stream::place_of("items for lost cores")] = 9;
  frame.end.link_counters[stream::place_of("starts since power-up")] = 2;
  frame.end.link_counters[stream::place_of("end of the run before")] = 1;
  EXPECT_EQ(found_in(frame, "cores").level, DiagnosticLevel::kWarn);
  EXPECT_EQ(found_in(frame, "starts").message, "2 since power-up; before: reset without a word");
  EXPECT_EQ(found_in(frame, "starts").level, DiagnosticLevel::kWarn);
}

}  // namespace
}  // namespace iog::tools
