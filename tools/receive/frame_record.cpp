#include "tools/receive/frame_record.hpp"

#include <algorithm>
#include <array>
#include <iomanip>
#include <iterator>
#include <sstream>
#include <utility>

#include "tools/program/hexadecimal.hpp"
#include "tools/program/joined.hpp"
#include "tools/program/table.hpp"
#include "tools/receive/record_file.hpp"

namespace iog::tools {
namespace {

constexpr const char* kRecordHeading =
    "# frame complete_sensors partial_sensors packets points_used tiles grid_crc";

// "6,6,6,6"
std::string list_of(const std::vector<std::uint16_t>& packets) {
  return packets.empty()
             ? "-"
             : joined(packets, ",", [](std::uint16_t count) { return std::to_string(count); });
}

// Nothing if it is not the list of what it holds.
std::optional<std::vector<std::uint16_t>> packets_in(const std::string& list) {
  std::string numbers = list;
  std::ranges::replace(numbers, ',', ' ');
  std::istringstream in(numbers);
  std::vector<std::uint16_t> packets(std::istream_iterator<std::uint16_t>(in), {});
  const bool is_list = packets.size() <= vehicle::kMaxSensors && list_of(packets) == list;
  return is_list ? std::optional(std::move(packets)) : std::nullopt;
}

std::string sensors_of(const FrameRecord& record) {
  std::ostringstream text;
  text << std::hex << "sensors complete " << unsigned{record.complete_sensors} << ", partial "
       << unsigned{record.partial_sensors} << std::dec << ", packets " << list_of(record.packets)
       << ", points " << record.points_used;
  return text.str();
}

std::optional<FrameRecord> parsed(const std::string& line) {
  FrameRecord record;
  unsigned complete = 0;
  unsigned partial = 0;
  std::string packets_text;
  std::istringstream text(line);
  text >> record.number >> std::hex >> complete >> partial >> std::dec >> packets_text >>
      record.points_used >> record.tiles >> std::hex >> record.grid_crc;
  auto packets = packets_in(packets_text);
  if (text.fail() || complete > 0xFF || partial > 0xFF || !packets) {
    return std::nullopt;
  }
  record.packets = *std::move(packets);
  record.complete_sensors = static_cast<std::uint8_t>(complete);
  record.partial_sensors = static_cast<std::uint8_t>(partial);
  return record;
}

}  // namespace

FrameRecord record_of(const GridFrame& frame) {
  std::vector<std::uint16_t> packets;
  if (frame.has_end) {
    const std::size_t sensors =
        std::min<std::size_t>(frame.header.sensor_count, vehicle::kMaxSensors);
    for (const intake::SensorReport& sensor : std::span(frame.end.sensors).first(sensors)) {
      packets.push_back(sensor.packets);
    }
  }
  const bool is_verified = frame.header.has_indexes() && frame.is_whole() && !frame.is_damaged;
  return {.number = frame.evidence_number,
          .complete_sensors = frame.header.complete_sensors,
          .partial_sensors = frame.header.partial_sensors,
          .packets = std::move(packets),
          .points_used = frame.header.points_used,
          .tiles = frame.tiles,
          .grid_crc = is_verified ? frame.end.grid_crc : grid_crc_of(frame),
          .is_timed_out = (frame.header.flags & stream::kFlagTimedOut) != 0,
          .is_too_slow = frame.has_end && points_not_taken(frame.end) > 0};
}

std::uint32_t points_not_taken(const stream::FrameEnd& end) {
  return end.fates[static_cast<std::size_t>(vehicle::Fate::kNotTaken)];
}

std::string line_of(const FrameRecord& record) {
  std::ostringstream text;
  text << record.number << ' ' << std::hex << unsigned{record.complete_sensors} << ' '
       << unsigned{record.partial_sensors} << ' ' << std::dec << list_of(record.packets) << ' '
       << record.points_used << ' ' << record.tiles << ' ' << hex(record.grid_crc);
  return text.str();
}

std::vector<FrameRecord> read_records(const std::string& path) {
  return read_record_file<FrameRecord>(path, parsed, "--hashes");
}

void write_records(const std::string& path, const std::vector<FrameRecord>& records) {
  write_record_file(path, kRecordHeading, records);
}

void RunHash::add(std::uint32_t grid_crc) {
  std::array<std::byte, 4> bytes{};
  wire::store_be32(bytes, grid_crc);
  crc_.update(bytes);
}

namespace {

// Why other packets took part in a frame than should have. The points that a target leaves are
// counted in the frame that it works on next.
const char* cause_of(const std::vector<FrameRecord>& received, std::size_t frame) {
  constexpr std::size_t kAround = 3;
  for (std::size_t i = frame - std::min(frame, kAround);
       i < std::min(frame + kAround + 1, received.size()); ++i) {
    if (received[i].is_too_slow) {
      return "the target is too slow for its sensors;";
    }
  }
  return received[frame].is_timed_out ? "closed by time on the target; was the host stalled?"
                                      : "other packets took part";
}

}  // namespace

std::optional<std::string> first_difference(const std::vector<FrameRecord>& received,
                                            const std::vector<FrameRecord>& expected) {
  const std::size_t common = std::min(received.size(), expected.size());
  for (std::size_t i = 0; i < common; ++i) {
    const std::string name = "frame " + std::to_string(i);
    if (!received[i].has_same_participation(expected[i])) {
      return name + ": " + cause_of(received, i) + " received " + sensors_of(received[i]) +
             "; expected " + sensors_of(expected[i]);
    }
    if (!received[i].has_same_grid(expected[i])) {
      return name + ": same packets, another grid: received " + hex(received[i].grid_crc) +
             ", expected " + hex(expected[i].grid_crc);
    }
  }
  if (received.size() != expected.size()) {
    return counted(received.size(), "frame|frames with evidence received, ") +
           std::to_string(expected.size()) + " expected; the common ones are equal";
  }
  return std::nullopt;
}

}  // namespace iog::tools
