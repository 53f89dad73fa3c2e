#include "tools/record/frame_diagnostics.hpp"

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <string>
#include <utility>

#include "hal/thermometer.hpp"
#include "tools/program/hexadecimal.hpp"
#include "tools/receive/frame_record.hpp"
#include "tools/report/counters.hpp"
#include "tools/report/map_words.hpp"
#include "tools/report/names.hpp"
#include "tools/report/words.hpp"
#include "tools/vehicles/vehicle_catalogue.hpp"

namespace iog::tools {
namespace {

using ros::Diagnostic;
using ros::DiagnosticLevel;
using Values = std::vector<std::pair<std::string, std::string>>;

// As long as a scanner of 5 Hz takes for a turn.
constexpr std::uint64_t kSilenceUs = 200'000;

// A value for each that is not 0.
template <typename Counts, typename Names>
Values counted(const Counts& counts, const Names& names) {
  Values values;
  for (std::size_t i = 0; i < names.size(); ++i) {
    if (counts[i] > 0) {
      values.emplace_back(names[i], std::to_string(counts[i]));
    }
  }
  return values;
}

std::string name_of_sensor(const CatalogueEntry* car, std::size_t number) {
  const bool is_known = car != nullptr && number < car->sensors.size();
  return "sensor " + (is_known ? std::string(car->sensors[number].name) : std::to_string(number));
}

Diagnostic of_sensor(const intake::SensorReport& sensor, const CatalogueEntry* car,
                     std::size_t number) {
  using intake::SensorState;
  const auto state = std::min(static_cast<std::size_t>(sensor.state), kSensorStateNames.size() - 1);
  const auto blocked = std::min(static_cast<std::size_t>(sensor.blocked), kBlockedNames.size() - 1);
  const std::uint64_t period_us = car != nullptr ? car->vehicle->frame_period_us : 0;
  const bool is_lately = sensor.age_frames * period_us <= kSilenceUs;
  const bool is_lost = sensor.state == SensorState::kNeverSeen ||
                       (sensor.state == SensorState::kSilent && !is_lately) ||
                       sensor.blocked == intake::Blocked::kWhole;
  const bool is_partly = sensor.blocked == intake::Blocked::kPartly;
  return {.level = is_lost     ? DiagnosticLevel::kError
                   : is_partly ? DiagnosticLevel::kWarn
                               : DiagnosticLevel::kOk,
          .name = name_of_sensor(car, number),
          .message = std::string(kSensorStateNames[state]) + std::string(kBlockedNames[blocked]),
          .values = {{"frames since it took part", sensor.age_frames == 0xFFFF
                                                       ? "never, or more than 65534"
                                                       : std::to_string(sensor.age_frames)},
                     {"packets", std::to_string(sensor.packets)},
                     {"points", std::to_string(sensor.points)},
                     {"scan", std::to_string(sensor.scan_number)}}};
}

Diagnostic of_surroundings(std::uint64_t unwatched, std::uint64_t blocked) {
  const std::string words = words_of_sectors(unwatched);
  const bool is_all = unwatched == ~std::uint64_t{0};
  return {.level = unwatched == 0 ? DiagnosticLevel::kOk
                   : is_all       ? DiagnosticLevel::kError
                                  : DiagnosticLevel::kWarn,
          .name = "surroundings",
          .message = unwatched == 0 ? "watched all around" : "not watched: " + words,
          .values = {{"sectors", hex(unwatched, 16)}, {"blocked", words_of_sectors(blocked)}}};
}

Diagnostic of_chip(std::int16_t temperature_dc) {
  const std::string words = words_of_temperature(temperature_dc);
  return {.level = temperature_dc >= kTooHotDc ? DiagnosticLevel::kError
                   : temperature_dc >= kWarmDc ? DiagnosticLevel::kWarn
                                               : DiagnosticLevel::kOk,
          .name = "chip",
          .message = temperature_dc >= kTooHotDc ? "too hot: " + words
                     : temperature_dc >= kWarmDc ? "warm: " + words
                                                 : words};
}

// What has come of the frame.
Diagnostic of_stream(const GridFrame& frame) {
  const bool is_damaged = frame.is_damaged || (frame.classes && frame.classes->is_damaged);
  const bool is_whole = frame.is_whole() && (!frame.classes || frame.classes->is_whole()) &&
                        (!frame.header.has_objects() || frame.objects);
  return {.level = is_damaged ? DiagnosticLevel::kError
                   : is_whole ? DiagnosticLevel::kOk
                              : DiagnosticLevel::kWarn,
          .name = "stream",
          .message = is_damaged ? "damaged"
                     : is_whole ? "whole"
                                : "messages are missing",
          .values = {{"frame", std::to_string(frame.header.frame_number)},
                     {"run", hex(frame.header.run_number)},
                     {"tiles", std::to_string(frame.tiles)}}};
}

Diagnostic of_points(const stream::FrameEnd& end) {
  const std::uint32_t left = points_not_taken(end);
  return {.level = left > 0 ? DiagnosticLevel::kError : DiagnosticLevel::kOk,
          .name = "points",
          .message = left > 0 ? "the target is too slow: " + std::to_string(left) + " not taken"
                              : "all were looked at",
          .values = counted(end.fates, kPointFateNames)};
}

Diagnostic of_datagrams(const stream::FrameEnd& end) {
  const Values drops = counted(end.packet_drops, kPacketDropNames);
  return {.level = DiagnosticLevel::kOk,
          .name = "datagrams",
          .message = drops.empty() ? "none dropped" : "some dropped since the start",
          .values = drops};
}

// A target has its times; a PC has none.
Diagnostic of_loop(const LoopTimes& times) {
  Diagnostic loop{.level = DiagnosticLevel::kOk, .name = "loop", .message = "since the start"};
  for (std::size_t row = 0; row < times.rows.size(); ++row) {
    if (times.rows[row].count() > 0) {
      loop.values.emplace_back(kLoopTimeNames[row], words_of(times.rows[row]));
    }
  }
  return loop;
}

Diagnostic of_cores(const work::TeamCounts& shares) {
  return {.level = shares.for_lost > 0 ? DiagnosticLevel::kWarn : DiagnosticLevel::kOk,
          .name = "cores",
          .message = words_of(shares)};
}

Diagnostic of_starts(const hal::RunBefore& before) {
  const bool is_again = before.starts > 1;
  return {.level = is_again ? DiagnosticLevel::kWarn : DiagnosticLevel::kOk,
          .name = "starts",
          .message = words_of(before)};
}

// The causes of this frame; those that make the window unknown are errors.
Diagnostic of_poses(const ClassGrid& classes) {
  constexpr std::array<std::pair<std::uint16_t, std::string_view>, 8> kBits{
      {{stream::kCauseLate, "late"},
       {stream::kCauseLost, "lost"},
       {stream::kCauseImprecise, "imprecise"},
       {stream::kCauseJump, "jump"},
       {stream::kCauseRestart, "restart"},
       {stream::kCauseOverBudget, "over budget"},
       {stream::kCauseContradicted, "contradicted"},
       {stream::kCauseDrifting, "drifting"}}};
  constexpr unsigned kUnknown = stream::kCauseLost | stream::kCauseJump | stream::kCauseRestart |
                                stream::kCauseContradicted | stream::kCauseDrifting;
  std::string words;
  for (const auto& [bit, name] : kBits) {
    if ((classes.window.causes & bit) != 0) {
      words.append(words.empty() ? "" : ", ").append(name);
    }
  }
  const bool is_lost = (classes.window.causes & kUnknown) != 0;
  Diagnostic poses{.level = is_lost         ? DiagnosticLevel::kError
                            : words.empty() ? DiagnosticLevel::kOk
                                            : DiagnosticLevel::kWarn,
                   .name = "poses",
                   .message = words.empty() ? "in order" : words};
  poses.values = counted(classes.end.pose_fates, kPoseFateNames);
  poses.values.insert(
      poses.values.begin(),
      {{"slices placed", std::to_string(classes.window.slices)},
       {"packets placed", std::to_string(classes.end.packets_placed)},
       {"packets without a place", std::to_string(classes.end.packets_not_placed)}});
  return poses;
}

Diagnostic of_map(const stream::MapState& state) {
  const std::string_view why_not = words_of(state.layer.cause);
  Values facts = map_facts(state);
  std::erase_if(facts, [](const auto& fact) { return fact.second == "0"; });
  return {.level = DiagnosticLevel::kOk,
          .name = "map",
          .message = std::string(why_not.empty() ? "in use" : why_not),
          .values = std::move(facts)};
}

}  // namespace

std::vector<Diagnostic> diagnostics_of(const GridFrame& frame) {
  std::vector<Diagnostic> all{of_stream(frame)};
  const CatalogueEntry* const car = vehicle_of_id(frame.header.vehicle_id);
  if (frame.has_end) {
    const stream::FrameEnd& end = frame.end;
    for (std::size_t i = 0;
         i < std::min<std::size_t>(frame.header.sensor_count, end.sensors.size()); ++i) {
      all.push_back(of_sensor(end.sensors[i], car, i));
    }
    all.push_back(of_surroundings(end.unwatched, end.blocked));
    if (end.temperature_dc != hal::kTemperatureNotKnown) {
      all.push_back(of_chip(end.temperature_dc));
    }
    all.push_back(of_points(end));
    all.push_back(of_datagrams(end));
    if (const auto times = stream::counts_of<LoopTimes>(end)) {
      all.push_back(of_loop(*times));
    }
    if (const auto shares = stream::counts_of<work::TeamCounts>(end)) {
      all.push_back(of_cores(*shares));
    }
    if (const auto before = stream::counts_of<hal::RunBefore>(end)) {
      all.push_back(of_starts(*before));
    }
  }
  if (frame.classes && frame.classes->has_end) {
    all.push_back(of_poses(*frame.classes));
    all.push_back(of_map(frame.classes->end.map));
  }
  return all;
}

}  // namespace iog::tools
