#include "tools/receive/frame_record.hpp"

#include <algorithm>
#include <array>
#include <iomanip>
#include <sstream>

#include "tools/program/exit_status.hpp"
#include "tools/program/file.hpp"

namespace iog::tools {
namespace {

std::string sensors_of(const FrameRecord& record) {
  std::ostringstream text;
  text << std::hex << "sensors complete " << unsigned{record.complete_sensors} << ", partial "
       << unsigned{record.partial_sensors} << std::dec << ", points " << record.points_used;
  return text.str();
}

std::optional<FrameRecord> parsed(const std::string& line) {
  FrameRecord record;
  unsigned complete = 0;
  unsigned partial = 0;
  std::istringstream text(line);
  text >> record.number >> std::hex >> complete >> partial >> std::dec >> record.points_used >>
      record.tiles >> std::hex >> record.grid_crc;
  if (text.fail() || complete > 0xFF || partial > 0xFF) {
    return std::nullopt;
  }
  record.complete_sensors = static_cast<std::uint8_t>(complete);
  record.partial_sensors = static_cast<std::uint8_t>(partial);
  return record;
}

}  // namespace

FrameRecord record_of(const GridFrame& frame) {
  return {.number = frame.evidence_number,
          .complete_sensors = frame.header.complete_sensors,
          .partial_sensors = frame.header.partial_sensors,
          .points_used = frame.header.points_used,
          .tiles = frame.tiles,
          .grid_crc = grid_crc_of(frame),
          .is_timed_out = (frame.header.flags & stream::kFlagTimedOut) != 0};
}

std::string hex(std::uint32_t value) {
  std::ostringstream text;
  text << std::hex << std::setw(8) << std::setfill('0') << value;
  return text.str();
}

std::string line_of(const FrameRecord& record) {
  std::ostringstream text;
  text << record.number << ' ' << std::hex << unsigned{record.complete_sensors} << ' '
       << unsigned{record.partial_sensors} << ' ' << std::dec << record.points_used << ' '
       << record.tiles << ' ' << hex(record.grid_crc);
  return text.str();
}

std::vector<FrameRecord> read_records(const std::string& path) {
  std::vector<FrameRecord> records;
  for (const std::string& line : read_lines(path)) {
    if (line.empty() || line.front() == '#') {
      continue;
    }
    const std::optional<FrameRecord> record = parsed(line);
    if (!record || record->number != records.size()) {
      throw UsageError(path + ": line for frame " + std::to_string(records.size()) +
                       " expected; give a file that --hashes has written");
    }
    records.push_back(*record);
  }
  return records;
}

void write_records(const std::string& path, const std::vector<FrameRecord>& records) {
  OutputFile file(path);
  file.write(std::string(kRecordHeading) + "\n");
  for (const FrameRecord& record : records) {
    file.write(line_of(record) + "\n");
  }
  file.finish();
}

void RunHash::add(const FrameRecord& record) {
  std::array<std::byte, 4> bytes{};
  wire::store_be32(bytes, record.grid_crc);
  crc_.update(bytes);
}

std::optional<std::string> first_difference(const std::vector<FrameRecord>& received,
                                            const std::vector<FrameRecord>& expected) {
  const std::size_t common = std::min(received.size(), expected.size());
  for (std::size_t i = 0; i < common; ++i) {
    const std::string name = "frame " + std::to_string(i);
    if (!received[i].has_same_participation(expected[i])) {
      const char* const cause = received[i].is_timed_out
                                    ? "closed by time on the target; was the host stalled?"
                                    : "other packets took part";
      return name + ": " + cause + " received " + sensors_of(received[i]) + "; expected " +
             sensors_of(expected[i]);
    }
    if (!received[i].has_same_grid(expected[i])) {
      return name + ": same packets, another grid: received " + hex(received[i].grid_crc) +
             ", expected " + hex(expected[i].grid_crc);
    }
  }
  if (received.size() != expected.size()) {
    return std::to_string(received.size()) + " frames with evidence received, " +
           std::to_string(expected.size()) + " expected; the common ones are equal";
  }
  return std::nullopt;
}

}  // namespace iog::tools
