#include "tools/view/status.hpp"

#include <numbers>
#include <span>

#include "geometry/grid.hpp"
#include "lidar/formats.hpp"
#include "tools/program/hexadecimal.hpp"
#include "tools/receive/core_shares.hpp"
#include "tools/receive/frame_record.hpp"
#include "tools/receive/map_words.hpp"
#include "tools/view/json_text.hpp"

namespace iog::tools::view {
namespace {

std::string numbers(std::span<const std::uint32_t> values) {
  JsonList list;
  for (const std::uint32_t value : values) {
    list.json(std::to_string(value));
  }
  return list.str();
}

std::string sensors_json(const FrameFacts& frame) {
  JsonList list;
  for (const intake::SensorReport& sensor :
       std::span(frame.end->sensors).first(frame.header.sensor_count)) {
    list.json(JsonObject()
                  .number("state", static_cast<unsigned>(sensor.state))
                  .number("age", sensor.age_frames)
                  .number("packets", sensor.packets)
                  .number("points", sensor.points)
                  .number("scan", sensor.scan_number)
                  .str());
  }
  return list.str();
}

std::string end_json(const FrameFacts& frame) {
  if (!frame.end) {
    return "null";
  }
  const stream::FrameEnd& end = *frame.end;
  const auto us = [&](std::uint32_t ticks) {
    return end.stopwatch_hz == 0 ? 0.0 : 1e6 * ticks / end.stopwatch_hz;
  };
  const std::optional<CoreShares> cores = core_shares_of(end);
  return JsonObject()
      .number("tiles_sent", end.tiles_sent)
      .number("tiles_lost", end.tiles_lost)
      .text("crc", hex(end.grid_crc))
      .number("opened_us", end.opened_us)
      .real("fuse_us", us(end.ticks.fuse))
      .real("mark_us", us(end.ticks.mark))
      .real("publish_us", us(end.ticks.publish))
      .real("perceive_us", us(end.ticks.perceive))
      .number("stack_bytes", end.stack_used_bytes)
      .text("cores", cores ? words_of(*cores) : "")
      .json("fates", numbers(end.fates))
      .json("drops", numbers(end.packet_drops))
      .json("sensors", sensors_json(frame))
      .str();
}

// Each cause of docs/spec.md 5.5, from late on.
std::string causes_json(const ClassFacts& classes) {
  JsonList list;
  for (std::size_t cause = 1; cause < pose::kCauseCount; ++cause) {
    const stream::CauseRecord& record = classes.end->causes.at(cause);
    list.json(JsonObject()
                  .number("slices", classes.not_placed.at(cause))
                  .number("times", record.began.times)
                  .number("since_us", record.began.since_us)
                  .str());
  }
  return list.str();
}

// Where the local frame is in the map's plane; null if no pose has said it.
std::string transform_json(const std::optional<pose::MapTransform>& transform) {
  if (!transform) {
    return "null";
  }
  const pose::Pose& frame = transform->local_frame;
  return JsonObject()
      .real("x_m", frame.x_mm / 1000.0)
      .real("y_m", frame.y_mm / 1000.0)
      .real("heading_rad", frame.heading * (2 * std::numbers::pi / 0x1p32))
      .str();
}

// What the target says of its map; null if it knows nothing of maps.
std::string map_json(const std::optional<stream::MapState>& map) {
  if (!map) {
    return "null";
  }
  return JsonObject()
      .truth("in_use", map->in_use.has_value())
      .text("crc", hex(map->layer.crc))
      .text("attribution", map->in_use ? std::string(map->in_use->words()) : std::string())
      .text("cause", std::string(words_of(map->layer.cause)))
      .number("tiles_drawn", map->layer.tiles_drawn)
      .number("tiles_waiting", map->layer.tiles_waiting)
      .number("blur_cells", map->layer.radius)
      .text("delivery", words_of_delivery(map->delivery))
      .number("refused", map->delivery.blocks_refused)
      .json("transform", transform_json(map->layer.transform))
      .str();
}

std::string class_end_json(const ClassFacts& classes) {
  if (!classes.end) {
    return "null";
  }
  const stream::ClassEnd& end = *classes.end;
  return JsonObject()
      .text("crc", hex(end.classes_crc))
      .number("packets_placed", end.packets_placed)
      .number("packets_not_placed", end.packets_not_placed)
      .number("groups_fused", end.groups_fused)
      .number("groups_left", end.groups_left)
      .json("poses", numbers(end.pose_fates))
      .json("causes", causes_json(classes))
      .json("map", map_json(end.map))
      .str();
}

std::string classes_json(const FrameFacts& frame) {
  if (!frame.classes) {
    return "null";
  }
  const ClassFacts& classes = *frame.classes;
  const stream::ClassWindow& window = classes.window;
  return JsonObject()
      .number("corner_a", window.corner_a)
      .number("corner_b", window.corner_b)
      .real("x_m", window.pose.x_mm / 1000.0)
      .real("y_m", window.pose.y_mm / 1000.0)
      .real("heading_deg", window.pose.heading * (360 / 0x1p32))
      .real("sigma_m", window.sigma.position_mm / 1000.0)
      .real("sigma_deg", window.sigma.heading_10urad * 1e-5 * 180 / std::numbers::pi)
      .number("causes", window.causes)
      .truth("has_place", window.has_place())
      .number("slices", window.slices)
      .number("stamp_us", window.slices_end_us)
      .truth("whole", classes.is_whole)
      .truth("damaged", classes.is_damaged)
      .number("missing_tiles", classes.missing_tiles)
      .number("stale_tiles", classes.stale_tiles)
      .number("known_tiles", classes.known_tiles)
      .json("end", class_end_json(classes))
      .str();
}

std::string frame_json(const FrameFacts& frame) {
  const stream::Header& header = frame.header;
  return JsonObject()
      .number("number", frame.number)
      .number("closed_us", header.closed_us)
      .truth("sends_indexes", (header.flags & stream::kFlagNoIndexes) == 0)
      .truth("sends_classes", (header.flags & stream::kFlagClasses) != 0)
      .truth("timed_out", (header.flags & stream::kFlagTimedOut) != 0)
      .text("rule", (header.flags & stream::kFlagBayes) != 0 ? "bayes" : "hits_win")
      .number("bytes", frame.message_bytes)
      .truth("whole", frame.is_whole)
      .truth("damaged", frame.is_damaged)
      .number("missing_tiles", frame.missing_tiles)
      .truth("breaks_off", frame.breaks_off)
      .number("unfinished_tiles", frame.unfinished_tiles)
      .number("stale_tiles", frame.stale_tiles)
      .number("known_tiles", frame.known_tiles)
      .number("complete", header.complete_sensors)
      .number("partial", header.partial_sensors)
      .number("points_used", header.points_used)
      .number("points_other", header.points_other)
      .number("packets_fused", header.packets_fused)
      .number("packets_dropped", header.packets_dropped)
      .json("end", end_json(frame))
      .json("classes", classes_json(frame))
      .str();
}

std::string counts_json(const FrameAssembler& assembler, std::uint64_t overflow) {
  const MessageCounts& counts = assembler.counts();
  return JsonObject()
      .number("messages", counts.messages)
      .number("bytes", counts.bytes)
      .number("lost", assembler.messages_lost())
      .number("frames_lost", assembler.frames_lost())
      .number("late", counts.late)
      .number("repeated", counts.repeated)
      .number("too_late", counts.too_late)
      .number("corrupt", counts.corrupt)
      .number("malformed", counts.malformed + counts.tiles_malformed)
      .number("not_ours", counts.not_ours)
      .number("other_version", counts.other_version)
      .number("not_understood", counts.not_understood + counts.tiles_not_understood)
      .number("without_reference", counts.without_reference)
      .number("restarts", counts.restarts)
      .number("other_run", counts.other_run)
      .number("overflow", overflow)
      .str();
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

std::string recording_json(const Recorder& recorder) {
  return JsonObject()
      .truth("open", recorder.is_open())
      .text("file", recorder.path())
      .number("messages", recorder.messages())
      .number("bytes", recorder.bytes())
      .str();
}

std::string sensor_json(const vehicle::SensorConfig& sensor) {
  return JsonObject()
      .text("name", sensor.name)
      .text("format", lidar::name_of(sensor.format))
      .real("x", sensor.mount.x_m)
      .real("y", sensor.mount.y_m)
      .real("z", sensor.mount.z_m)
      .real("yaw_deg", sensor.mount.yaw_deg)
      .real("width_deg", 360.0 * sensor.scan_width_ticks / lidar::ticks_per_turn(sensor.format))
      .real("range", sensor.range_max_mm / 1000.0)
      .str();
}

// A target speaks of its tiles in the order of their numbers.
std::size_t tiles_behind_last(const GridFrame& frame) {
  std::size_t count = 0;
  while (count < geometry::kTileCount && !frame.valid_tiles[geometry::kTileCount - 1 - count]) {
    ++count;
  }
  return count;
}

}  // namespace

ClassFacts class_facts_of(const ClassGrid& frame, const LiveClasses& classes,
                          const ClassFacts* before) {
  ClassFacts facts{.window = frame.window,
                   .is_whole = frame.is_whole() || frame.is_damaged,
                   .is_damaged = frame.is_damaged,
                   .missing_tiles = geometry::kTileCount - frame.valid_tiles.count(),
                   .stale_tiles = classes.stale_tiles(),
                   .known_tiles = frame.known_tiles.count()};
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

FrameFacts facts_of(const GridFrame& frame, const LiveGrid& grid, std::uint64_t message_bytes,
                    bool breaks_off) {
  const bool has_indexes = (frame.header.flags & stream::kFlagNoIndexes) == 0;
  const std::size_t missing = geometry::kTileCount - frame.valid_tiles.count();
  const std::size_t unfinished = breaks_off && has_indexes ? tiles_behind_last(frame) : 0;
  FrameFacts facts{.number = frame.header.frame_number,
                   .message_bytes = message_bytes,
                   .is_whole = frame.is_whole() || frame.is_damaged,
                   .is_damaged = frame.is_damaged,
                   .missing_tiles = has_indexes ? missing - unfinished : 0,
                   .breaks_off = breaks_off,
                   .unfinished_tiles = unfinished,
                   .stale_tiles = grid.stale_tiles(),
                   .known_tiles = frame.tiles,
                   .header = frame.header};
  if (frame.has_end) {
    facts.end = frame.end;
  }
  return facts;
}

std::string status_json(const StatusParts& parts) {
  const StreamHealth& health = *parts.health;
  const auto version_sent = parts.assembler->version_sent();
  JsonObject object;
  object.text("kind", parts.kind)
      .text("source", parts.source)
      .text("problem", parts.problem)
      .text("block", parts.block)
      .text("state", name_of(health.state(parts.now_ms)))
      .number("now_ms", parts.now_ms)
      .number("silent_ms", health.silent_ms(parts.now_ms))
      .truth("restarted", health.has_restarted_lately(parts.now_ms))
      .truth("corrupt", health.is_corrupt_lately(parts.now_ms))
      .truth("too_slow", health.is_too_slow_lately(parts.now_ms))
      .truth("other_version", health.has_other_version_lately(parts.now_ms))
      .truth("strange_grid", health.has_strange_grid_lately(parts.now_ms))
      .number("version", stream::kInterfaceVersion)
      .json("version_sent", version_sent ? std::to_string(*version_sent) : "null")
      .text("car_refused", parts.assembler->car_refusal().value_or(""))
      .text("channel", channel_name(parts.assembler->channel()))
      .json("counts", counts_json(*parts.assembler, parts.overflow))
      .json("recording", recording_json(*parts.recorder))
      .json("frame", *parts.frame ? frame_json(**parts.frame) : "null");
  return object.str();
}

std::string vehicle_json(std::uint32_t vehicle_id) {
  const CatalogueEntry* const car = vehicle_of_id(vehicle_id);
  JsonObject object;
  object.text("name", words_of_vehicle(vehicle_id))
      .real("cell_m", geometry::kCellMm / 1000.0)
      .number("cells", geometry::kCellsPerSide);
  JsonList sensors;
  if (car != nullptr) {
    for (const vehicle::SensorConfig& sensor : car->sensors) {
      sensors.json(sensor_json(sensor));
    }
    const vehicle::FootprintConfig& body = car->description->footprint;
    object
        .json("footprint", JsonObject()
                               .real("x_min", body.x_min_m)
                               .real("x_max", body.x_max_m)
                               .real("y_min", body.y_min_m)
                               .real("y_max", body.y_max_m)
                               .str())
        .real("z_min", car->description->z_min_m)
        .real("z_max", car->description->z_max_m)
        .real("epsilon", car->description->epsilon)
        .number("period_us", car->description->frame_period_us);
  } else {
    object.json("footprint", "null").real("epsilon", vehicle::Description{}.epsilon);
  }
  return object.json("sensors", sensors.str()).str();
}

}  // namespace iog::tools::view
