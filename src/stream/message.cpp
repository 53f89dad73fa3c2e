#include "stream/message.hpp"

#include "wire/byte_order.hpp"
#include "wire/byte_reader.hpp"
#include "wire/byte_writer.hpp"

namespace iog::stream {
namespace {

// The list may grow in later versions: the message gives the number of records and their length.
constexpr std::uint8_t kSensorRecordBytes = 16;
// After the temperature.
constexpr std::size_t kReservedBytes = 6;

constexpr std::size_t kSequenceOffset = 4;

std::size_t written_bytes(const wire::ByteWriter& out) {
  return out.ok() ? out.written().size() : 0;
}

void write_counters(std::span<const std::uint32_t> counters, wire::ByteWriter& out) {
  for (const std::uint32_t counter : counters) {
    out.u32_be(counter);
  }
}

// Reads `count` counters and skips those beyond ours.
void read_counters(std::uint8_t count, std::span<std::uint32_t> counters, wire::ByteReader& in) {
  for (std::size_t i = 0; i < count; ++i) {
    const std::uint32_t value = in.u32_be();
    if (i < counters.size()) {
      counters[i] = value;
    }
  }
}

void write_sensor(const intake::SensorReport& sensor, wire::ByteWriter& out) {
  out.u8(static_cast<std::uint8_t>(sensor.state));
  out.u8(static_cast<std::uint8_t>(sensor.blocked));
  out.u16_be(sensor.age_frames);
  out.u16_be(sensor.packets);
  out.u16_be(0);
  out.u32_be(sensor.points);
  out.u32_be(sensor.scan_number);
}

intake::SensorReport read_sensor(wire::ByteReader& in) {
  intake::SensorReport sensor;
  sensor.state = static_cast<intake::SensorState>(in.u8());
  sensor.blocked = static_cast<intake::Blocked>(in.u8());
  sensor.age_frames = in.u16_be();
  sensor.packets = in.u16_be();
  in.skip(2);
  sensor.points = in.u32_be();
  sensor.scan_number = in.u32_be();
  return sensor;
}

}  // namespace

std::size_t write_header(const Header& header, std::span<std::byte> buffer) {
  wire::ByteWriter out(buffer);
  out.u8(static_cast<std::uint8_t>(header.type));
  out.u8(header.flags);
  out.u16_be(kHeaderBytes);
  out.u32_be(header.sequence);
  out.u32_be(header.frame_number);
  out.u64_be(header.closed_us);
  out.u32_be(header.vehicle_id);
  out.u8(header.sensor_count);
  out.u8(header.complete_sensors);
  out.u8(header.partial_sensors);
  out.u8(0);
  out.u32_be(header.points_used);
  out.u32_be(header.points_other);
  out.u32_be(header.packets_fused);
  out.u32_be(header.packets_dropped);
  out.u32_be(header.run_number);
  return written_bytes(out);
}

void set_sequence(std::span<std::byte, kHeaderBytes> header, std::uint32_t sequence) {
  wire::store_be32(header.subspan<kSequenceOffset, 4>(), sequence);
}

ReadStatus read_header(std::span<const std::byte> content, Header& header,
                       std::span<const std::byte>& body) {
  wire::ByteReader in(content);
  header.type = static_cast<MessageType>(in.u8());
  header.flags = in.u8();
  const std::uint16_t header_bytes = in.u16_be();
  header.sequence = in.u32_be();
  header.frame_number = in.u32_be();
  header.closed_us = in.u64_be();
  header.vehicle_id = in.u32_be();
  header.sensor_count = in.u8();
  header.complete_sensors = in.u8();
  header.partial_sensors = in.u8();
  in.skip(1);
  header.points_used = in.u32_be();
  header.points_other = in.u32_be();
  header.packets_fused = in.u32_be();
  header.packets_dropped = in.u32_be();
  header.run_number = in.u32_be();
  if (!in.ok() || header_bytes < kHeaderBytes || header_bytes > content.size()) {
    return ReadStatus::kTooShort;
  }
  body = content.subspan(header_bytes);
  return ReadStatus::kOk;
}

std::size_t write_frame_end(const FrameEnd& end, std::uint8_t sensor_count,
                            std::span<std::byte> buffer) {
  wire::ByteWriter out(buffer);
  out.u32_be(end.tiles_sent);
  out.u32_be(end.tiles_lost);
  out.u32_be(end.grid_crc);
  out.u32_be(end.stack_used_bytes);
  out.u64_be(end.opened_us);
  out.u32_be(end.stopwatch_hz);
  out.u8(kStageCount);
  out.u8(vehicle::kFateCount);
  out.u8(intake::kPacketDropCount);
  out.u8(end.link_counter_count);
  write_counters(std::array{end.ticks.fuse, end.ticks.mark, end.ticks.publish, end.ticks.perceive},
                 out);
  write_counters(end.fates, out);
  write_counters(end.packet_drops, out);
  write_counters(std::span(end.link_counters).first(end.link_counter_count), out);
  out.u8(kSensorRecordBytes);
  out.zeros(3);
  for (std::size_t i = 0; i < sensor_count; ++i) {
    write_sensor(end.sensors[i], out);
  }
  out.u64_be(end.unwatched);
  out.u64_be(end.blocked);
  out.u16_be(static_cast<std::uint16_t>(end.temperature_dc));
  out.zeros(kReservedBytes);
  return written_bytes(out);
}

ReadStatus read_frame_end(std::span<const std::byte> body, std::uint8_t sensor_count,
                          FrameEnd& end) {
  wire::ByteReader in(body);
  end.tiles_sent = in.u32_be();
  end.tiles_lost = in.u32_be();
  end.grid_crc = in.u32_be();
  end.stack_used_bytes = in.u32_be();
  end.opened_us = in.u64_be();
  end.stopwatch_hz = in.u32_be();
  const std::uint8_t stages = in.u8();
  const std::uint8_t fates = in.u8();
  const std::uint8_t packet_drops = in.u8();
  const std::uint8_t link_counters = in.u8();
  std::array<std::uint32_t, kStageCount> ticks{};
  read_counters(stages, ticks, in);
  end.ticks = {.fuse = ticks[0], .mark = ticks[1], .publish = ticks[2], .perceive = ticks[3]};
  read_counters(fates, end.fates, in);
  read_counters(packet_drops, end.packet_drops, in);
  read_counters(link_counters, end.link_counters, in);
  end.link_counter_count = static_cast<std::uint8_t>(
      link_counters < kMaxLinkCounters ? link_counters : kMaxLinkCounters);
  const std::uint8_t record_bytes = in.u8();
  in.skip(3);
  if (!in.ok()) {
    return ReadStatus::kTooShort;
  }
  if (record_bytes < kSensorRecordBytes || sensor_count > vehicle::kMaxSensors) {
    return ReadStatus::kInconsistent;
  }
  for (std::size_t i = 0; i < sensor_count; ++i) {
    end.sensors[i] = read_sensor(in);
    in.skip(record_bytes - std::size_t{kSensorRecordBytes});
  }
  end.unwatched = in.u64_be();
  end.blocked = in.u64_be();
  end.temperature_dc = static_cast<std::int16_t>(in.u16_be());
  in.skip(kReservedBytes);
  return in.ok() ? ReadStatus::kOk : ReadStatus::kTooShort;
}

}  // namespace iog::stream
