#include "tools/view/status.hpp"

#include <span>

#include "geometry/grid.hpp"
#include "lidar/ibeo_lux.hpp"
#include "lidar/velodyne_vlp16.hpp"
#include "tools/receive/frame_record.hpp"
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
  return JsonObject()
      .number("tiles_sent", end.tiles_sent)
      .number("tiles_lost", end.tiles_lost)
      .text("crc", hex(end.grid_crc))
      .number("opened_us", end.opened_us)
      .real("fuse_us", us(end.ticks.fuse))
      .real("mark_us", us(end.ticks.mark))
      .real("publish_us", us(end.ticks.publish))
      .number("stack_bytes", end.stack_used_bytes)
      .json("fates", numbers(end.fates))
      .json("drops", numbers(end.packet_drops))
      .json("sensors", sensors_json(frame))
      .str();
}

std::string frame_json(const FrameFacts& frame) {
  const stream::Header& header = frame.header;
  return JsonObject()
      .number("number", frame.number)
      .number("closed_us", header.closed_us)
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

std::int32_t ticks_per_turn(lidar::Format format) {
  return format == lidar::Format::kIbeoLux ? lidar::IbeoLux::kTicksPerTurn
                                           : lidar::VelodyneVlp16::kTicksPerTurn;
}

std::string sensor_json(const vehicle::SensorConfig& sensor) {
  return JsonObject()
      .text("name", sensor.name)
      .text("format", sensor.format == lidar::Format::kIbeoLux ? "ibeo LUX" : "Velodyne VLP-16")
      .real("x", sensor.mount.x_m)
      .real("y", sensor.mount.y_m)
      .real("z", sensor.mount.z_m)
      .real("yaw_deg", sensor.mount.yaw_deg)
      .real("width_deg", 360.0 * sensor.scan_width_ticks / ticks_per_turn(sensor.format))
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

FrameFacts facts_of(const GridFrame& frame, const LiveGrid& grid, std::uint64_t message_bytes,
                    bool breaks_off) {
  const std::size_t unfinished = breaks_off ? tiles_behind_last(frame) : 0;
  FrameFacts facts{.number = frame.header.frame_number,
                   .message_bytes = message_bytes,
                   .is_whole = frame.is_whole() || frame.is_damaged,
                   .is_damaged = frame.is_damaged,
                   .missing_tiles = geometry::kTileCount - frame.valid_tiles.count() - unfinished,
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
  JsonObject object;
  object.text("kind", parts.kind)
      .text("source", parts.source)
      .text("problem", parts.problem)
      .text("state", name_of(health.state(parts.now_ms)))
      .number("now_ms", parts.now_ms)
      .number("silent_ms", health.silent_ms(parts.now_ms))
      .truth("restarted", health.has_restarted_lately(parts.now_ms))
      .truth("corrupt", health.is_corrupt_lately(parts.now_ms))
      .truth("other_version", health.has_other_version_lately(parts.now_ms))
      .truth("strange_grid", health.has_strange_grid_lately(parts.now_ms))
      .number("version", stream::kInterfaceVersion)
      .text("channel", channel_name(parts.assembler->channel()))
      .json("counts", counts_json(*parts.assembler, parts.overflow))
      .json("recording", recording_json(*parts.recorder))
      .json("frame", *parts.frame ? frame_json(**parts.frame) : "null");
  return object.str();
}

std::string vehicle_json(const CatalogueEntry* car) {
  JsonObject object;
  object.text("name", car == nullptr ? "unknown vehicle" : car->vehicle->name)
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
