#include "tools/receive/class_record.hpp"

#include <algorithm>
#include <sstream>

#include "tools/receive/frame_record.hpp"
#include "tools/receive/record_file.hpp"

namespace iog::tools {
namespace {

constexpr const char* kClassHeading =
    "# frame stamp_us slices packets_placed packets_not_placed causes corner_a corner_b tiles "
    "class_crc frames_of_time";

std::optional<ClassRecord> class_record_in(const std::string& line) {
  ClassRecord record;
  std::istringstream text(line);
  text >> record.number >> record.stamp_us >> record.slices >> record.packets_placed >>
      record.packets_not_placed >> std::hex >> record.causes >> std::dec >> record.corner_a >>
      record.corner_b >> record.tiles >> std::hex >> record.class_crc >> std::dec >>
      record.frames_of_time;
  return text.fail() ? std::nullopt : std::optional(record);
}

std::string place_of(const ClassRecord& record) {
  return std::to_string(record.slices) + " slices up to " + std::to_string(record.stamp_us) +
         " us, packets placed " + std::to_string(record.packets_placed) + ", not placed " +
         std::to_string(record.packets_not_placed);
}

std::string grid_of(const ClassRecord& record) {
  return hex(record.class_crc) + " (" + std::to_string(record.tiles) + " tiles from " +
         std::to_string(record.corner_a) + ", " + std::to_string(record.corner_b) + ")";
}

// Where only poses come for two periods, a frame without evidence is over and ages the window.
std::string words_of_time(const ClassRecord& received, const ClassRecord& expected) {
  if (received.frames_of_time == expected.frames_of_time) {
    return {};
  }
  return "; until then the window's time went on in " + std::to_string(received.frames_of_time) +
         " frames without evidence, expected " + std::to_string(expected.frames_of_time) +
         "; was the host stalled?";
}

}  // namespace

ClassRecord class_record_of(const GridFrame& frame, std::uint32_t frames_of_time) {
  const ClassGrid& classes = *frame.classes;
  return {.number = frame.evidence_number,
          .stamp_us = classes.window.slices_end_us,
          .slices = classes.window.slices,
          .packets_placed = classes.end.packets_placed,
          .packets_not_placed = classes.end.packets_not_placed,
          .causes = classes.window.causes,
          .corner_a = classes.window.corner_a,
          .corner_b = classes.window.corner_b,
          .tiles = static_cast<std::uint32_t>(classes.known_tiles.count()),
          .class_crc = class_crc_of(classes),
          .frames_of_time = frames_of_time};
}

std::string line_of(const ClassRecord& record) {
  std::ostringstream text;
  text << record.number << ' ' << record.stamp_us << ' ' << record.slices << ' '
       << record.packets_placed << ' ' << record.packets_not_placed << ' ' << std::hex
       << record.causes << std::dec << ' ' << record.corner_a << ' ' << record.corner_b << ' '
       << record.tiles << ' ' << hex(record.class_crc) << ' ' << record.frames_of_time;
  return text.str();
}

std::vector<ClassRecord> read_class_records(const std::string& path) {
  return read_record_file<ClassRecord>(path, class_record_in, "--classes-hashes");
}

void write_class_records(const std::string& path, const std::vector<ClassRecord>& records) {
  write_record_file(path, kClassHeading, records);
}

std::optional<std::string> first_difference(const std::vector<ClassRecord>& received,
                                            const std::vector<ClassRecord>& expected) {
  const std::size_t common = std::min(received.size(), expected.size());
  for (std::size_t i = 0; i < common; ++i) {
    const std::string name = "classes of frame " + std::to_string(i);
    if (!received[i].has_same_place(expected[i])) {
      return name + ": other slices were placed: received " + place_of(received[i]) +
             "; expected " + place_of(expected[i]);
    }
    if (!received[i].has_same_classes(expected[i])) {
      return name + ": same slices, other classes: received " + grid_of(received[i]) +
             ", expected " + grid_of(expected[i]) + words_of_time(received[i], expected[i]);
    }
  }
  if (received.size() != expected.size()) {
    return std::to_string(received.size()) + " frames with evidence and classes received, " +
           std::to_string(expected.size()) + " expected; the common ones are equal";
  }
  return std::nullopt;
}

}  // namespace iog::tools
