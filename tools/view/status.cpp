#include "tools/view/status.hpp"

#include <algorithm>
#include <nlohmann/json.hpp>
#include <numbers>
#include <span>
#include <utility>

#include "geometry/grid.hpp"
#include "hal/thermometer.hpp"
#include "lidar/formats.hpp"
#include "stream/channel.hpp"
#include "tools/program/hexadecimal.hpp"
#include "tools/receive/frame_record.hpp"
#include "tools/report/counters.hpp"
#include "tools/report/map_words.hpp"
#include "tools/report/words.hpp"

namespace iog::tools::view {
namespace {

using Json = nlohmann::ordered_json;

// Where a text is not UTF-8 the page has a character of replacement.
std::string text_of(const Json& json) {
  return json.dump(-1, ' ', false, Json::error_handler_t::replace);
}

Json sensors_json(const FrameFacts& frame) {
  Json list = Json::array();
  for (const intake::SensorReport& sensor :
       std::span(frame.end->sensors).first(frame.header.sensor_count)) {
    list.push_back({{"state", static_cast<unsigned>(sensor.state)},
                    {"blocked", static_cast<unsigned>(sensor.blocked)},
                    {"age", sensor.age_frames},
                    {"packets", sensor.packets},
                    {"points", sensor.points},
                    {"scan", sensor.scan_number}});
  }
  return list;
}

// Of the chip; null: not known.
Json temperature_json(const stream::FrameEnd& end) {
  const std::int16_t dc = end.temperature_dc;
  if (dc == hal::kTemperatureNotKnown) {
    return nullptr;
  }
  return {
      {"words", words_of_temperature(dc)}, {"warm", dc >= kWarmDc}, {"too_hot", dc >= kTooHotDc}};
}

Json end_json(const FrameFacts& frame) {
  if (!frame.end) {
    return nullptr;
  }
  const stream::FrameEnd& end = *frame.end;
  const auto us = [&](std::uint32_t ticks) {
    return end.stopwatch_hz == 0 ? 0.0 : 1e6 * ticks / end.stopwatch_hz;
  };
  const auto cores = stream::counts_of<work::TeamCounts>(end);
  const auto before = stream::counts_of<hal::RunBefore>(end);
  return {{"crc", hex(end.grid_crc)},
          {"fuse_us", us(end.ticks.fuse)},
          {"mark_us", us(end.ticks.mark)},
          {"publish_us", us(end.ticks.publish)},
          {"perceive_us", us(end.ticks.perceive)},
          {"stack_bytes", end.stack_used_bytes},
          {"cores", cores ? words_of(*cores) : ""},
          {"starts", before && before->starts > 1 ? words_of(*before) : ""},
          {"fates", end.fates},
          {"unwatched", hex(end.unwatched, 16)},
          {"blocked", hex(end.blocked, 16)},
          {"temperature", temperature_json(end)},
          {"sensors", sensors_json(frame)}};
}

// Each cause of docs/spec.md 5.5, from late on.
Json causes_json(const ClassFacts& classes) {
  Json list = Json::array();
  for (std::size_t cause = 1; cause < pose::kCauseCount; ++cause) {
    const stream::CauseRecord& record = classes.end->causes.at(cause);
    list.push_back({{"slices", classes.not_placed.at(cause)},
                    {"times", record.began.times},
                    {"since_us", record.began.since_us}});
  }
  return list;
}

// Where the local frame is in the map's plane; null if no pose has said it.
Json transform_json(const std::optional<pose::MapTransform>& transform) {
  if (!transform) {
    return nullptr;
  }
  const pose::Pose& frame = transform->local_frame;
  return {{"x_m", frame.x_mm / 1000.0},
          {"y_m", frame.y_mm / 1000.0},
          {"heading_rad", frame.heading * (2 * std::numbers::pi / 0x1p32)}};
}

// The state of the target's map.
Json map_json(const stream::MapState& map) {
  return {{"in_use", map.in_use.has_value()},
          {"crc", hex(map.layer.crc)},
          {"attribution", map.in_use ? std::string(map.in_use->words()) : std::string()},
          {"cause", std::string(words_of(map.layer.cause))},
          {"tiles_waiting", map.layer.tiles_waiting},
          {"delivery", words_of_delivery(map.delivery)},
          {"refused", map.delivery.blocks_refused},
          {"transform", transform_json(map.layer.transform)}};
}

Json class_end_json(const ClassFacts& classes) {
  if (!classes.end) {
    return nullptr;
  }
  const stream::ClassEnd& end = *classes.end;
  return {{"crc", hex(end.classes_crc)},
          {"packets_not_placed", end.packets_not_placed},
          {"poses", end.pose_fates},
          {"causes", causes_json(classes)},
          {"map", map_json(end.map)}};
}

Json classes_json(const FrameFacts& frame) {
  if (!frame.classes) {
    return nullptr;
  }
  const ClassFacts& classes = *frame.classes;
  const stream::ClassWindow& window = classes.window;
  const auto [columns, rows] = classes.extent.cells();
  return {{"cell_m", classes.cell_mm / 1000.0},
          {"columns", columns},
          {"rows", rows},
          {"corner_a", window.corner_a},
          {"corner_b", window.corner_b},
          {"x_m", window.pose.x_mm / 1000.0},
          {"y_m", window.pose.y_mm / 1000.0},
          {"heading_deg", window.pose.heading * (360 / 0x1p32)},
          {"sigma_m", window.sigma.position_mm / 1000.0},
          {"sigma_deg", window.sigma.heading_10urad * 1e-5 * 180 / std::numbers::pi},
          {"causes", window.causes},
          {"has_place", window.has_place()},
          {"slices", window.slices},
          {"stamp_us", window.slices_end_us},
          {"whole", classes.is_whole},
          {"damaged", classes.is_damaged},
          {"missing_tiles", classes.missing_tiles},
          {"stale_tiles", classes.stale_tiles},
          {"known_tiles", classes.known_tiles},
          {"end", class_end_json(classes)}};
}

Json objects_json(const FrameFacts& frame) {
  if (!frame.objects) {
    return nullptr;
  }
  return {{"refused", frame.objects->tracks_refused}, {"hits_left", frame.objects->hits_left}};
}

Json grid_json(const geometry::Grid& grid) {
  return {{"cell_m", grid.cell_mm / 1000.0},
          {"columns", grid.columns},
          {"rows", grid.rows},
          {"origin", {grid.origin_column, grid.origin_row}},
          {"tiles", grid.tile_count()}};
}

Json frame_json(const FrameFacts& frame) {
  const stream::Header& header = frame.header;
  return {{"number", frame.number},
          {"closed_us", header.closed_us},
          {"sends_indexes", (header.flags & stream::kFlagNoIndexes) == 0},
          {"sends_classes", (header.flags & stream::kFlagClasses) != 0},
          {"bytes", frame.message_bytes},
          {"whole", frame.is_whole},
          {"damaged", frame.is_damaged},
          {"missing_tiles", frame.missing_tiles},
          {"stale_tiles", frame.stale_tiles},
          {"known_tiles", frame.known_tiles},
          {"grid", grid_json(frame.grid)},
          {"complete", header.complete_sensors},
          {"partial", header.partial_sensors},
          {"end", end_json(frame)},
          {"classes", classes_json(frame)},
          {"objects", objects_json(frame)}};
}

Json counts_json(const FrameAssembler& assembler, std::uint64_t overflow) {
  const MessageCounts& counts = assembler.counts();
  return {{"messages", counts.messages},
          {"bytes", counts.bytes},
          {"lost", assembler.messages_lost()},
          {"frames_lost", assembler.frames_lost()},
          {"late", counts.late},
          {"corrupt", counts.corrupt},
          {"malformed", counts.malformed + counts.tiles_malformed},
          {"not_ours", counts.not_ours},
          {"other_version", counts.other_version},
          {"restarts", counts.restarts},
          {"other_run", counts.other_run},
          {"overflow", overflow}};
}

std::string_view channel_name(protection::ChannelState state) {
  switch (state) {
    case protection::ChannelState::kNoData:
      return "no data";
    case protection::ChannelState::kInit:
      return "init";
    case protection::ChannelState::kValid:
      return "valid";
    case protection::ChannelState::kInvalid:
      return "invalid";
  }
  return "invalid";
}

Json recording_json(const Recorder& recorder) {
  return {{"open", recorder.is_open()},
          {"file", recorder.path()},
          {"messages", recorder.messages()},
          {"bytes", recorder.bytes()}};
}

Json playback_json(const std::optional<Playback>& playback) {
  if (!playback) {
    return nullptr;
  }
  return {{"place_ms", playback->place_ms}, {"span_ms", playback->span_ms}};
}

Json sensor_json(const description::SensorConfig& sensor) {
  return {{"name", sensor.name},
          {"x", sensor.mount.x_m},
          {"y", sensor.mount.y_m},
          {"z", sensor.mount.z_m},
          {"yaw_deg", sensor.mount.yaw_deg},
          {"width_deg", 360.0 * sensor.scan_width_ticks / lidar::ticks_per_turn(sensor.format)},
          {"range", sensor.range_max_mm / 1000.0}};
}

}  // namespace

ClassFacts class_facts_of(const ClassGrid& frame, const LiveClasses& classes,
                          const ClassFacts* before) {
  ClassFacts facts{.window = frame.window,
                   .is_whole = frame.is_whole() || frame.is_damaged,
                   .is_damaged = frame.is_damaged,
                   .missing_tiles = std::min(geometry::kTileCount - frame.valid_tiles.count(),
                                             frame.extent.tile_count()),
                   .stale_tiles = classes.stale_tiles(),
                   .known_tiles = frame.known_tiles.count(),
                   .cell_mm = frame.cell_mm,
                   .extent = frame.extent};
  if (!frame.has_end) {
    return facts;
  }
  facts.end = frame.end;
  if (before == nullptr || !before->end) {
    return facts;
  }
  for (std::size_t cause = 1; cause < pose::kCauseCount; ++cause) {
    const stream::CauseRecord& now = frame.end.causes.at(cause);
    const stream::CauseRecord& then = before->end->causes.at(cause);
    // A new run begins anew.
    facts.not_placed.at(cause) = now.slices >= then.slices ? now.slices - then.slices : 0;
  }
  return facts;
}

FrameFacts facts_of(const GridFrame& frame, const LiveGrid& grid, std::uint64_t message_bytes) {
  const bool has_indexes = (frame.header.flags & stream::kFlagNoIndexes) == 0;
  // What is outside the grid is either all valid or, without any tiles, all missing.
  const std::size_t missing =
      std::min(geometry::kTileCount - frame.valid_tiles.count(), frame.shape.tile_count());
  FrameFacts facts{.number = frame.header.frame_number,
                   .message_bytes = message_bytes,
                   .is_whole = frame.is_whole() || frame.is_damaged,
                   .is_damaged = frame.is_damaged,
                   .missing_tiles = has_indexes ? missing : 0,
                   .stale_tiles = grid.stale_tiles(),
                   .known_tiles = frame.tiles,
                   .grid = frame.shape,
                   .header = frame.header};
  if (frame.has_end) {
    facts.end = frame.end;
  }
  if (frame.objects) {
    facts.objects = {.tracks_refused = frame.objects->tracks_refused,
                     .hits_left = frame.objects->hits_left};
  }
  return facts;
}

std::string status_json(const StatusParts& parts) {
  const StreamHealth& health = *parts.health;
  const auto version_sent = parts.assembler->version_sent();
  return text_of({{"kind", parts.kind},
                  {"source", parts.source},
                  {"problem", parts.problem},
                  {"block", parts.block},
                  {"state", name_of(health.state(parts.now_ms))},
                  {"now_ms", parts.now_ms},
                  {"silent_ms", health.silent_ms(parts.now_ms)},
                  {"restarted", health.has_restarted_lately(parts.now_ms)},
                  {"corrupt", health.is_corrupt_lately(parts.now_ms)},
                  {"too_slow", health.is_too_slow_lately(parts.now_ms)},
                  {"other_version", health.has_other_version_lately(parts.now_ms)},
                  {"version_read", stream::kInterfaceVersion},
                  {"version_sent", version_sent ? Json(*version_sent) : nullptr},
                  {"car_refused", parts.assembler->car_refusal().value_or("")},
                  {"channel", channel_name(parts.assembler->channel())},
                  {"counts", counts_json(*parts.assembler, parts.overflow)},
                  {"recording", recording_json(*parts.recorder)},
                  {"playback", playback_json(parts.playback)},
                  {"breaks_off", health.breaks_off()},
                  {"frame", *parts.frame ? frame_json(**parts.frame) : nullptr}});
}

std::string vehicle_json(std::uint32_t vehicle_id, std::optional<double> epsilon) {
  const CatalogueEntry* const car = vehicle_of_id(vehicle_id);
  Json sensors = Json::array();
  Json json{{"name", words_of_vehicle(vehicle_id)},
            {"footprint", nullptr},
            {"epsilon", epsilon ? Json(*epsilon) : nullptr}};
  if (car != nullptr) {
    for (const description::SensorConfig& sensor : car->sensors) {
      sensors.push_back(sensor_json(sensor));
    }
    const description::FootprintConfig& body = car->description->footprint;
    json["footprint"] = {{"x_min", body.x_min_m},
                         {"x_max", body.x_max_m},
                         {"y_min", body.y_min_m},
                         {"y_max", body.y_max_m}};
    json["period_us"] = car->description->frame_period_us;
  }
  json["sensors"] = std::move(sensors);
  return text_of(json);
}

}  // namespace iog::tools::view
