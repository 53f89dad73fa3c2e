#include "tools/receive/class_record.hpp"

#include <algorithm>
#include <array>
#include <iterator>
#include <span>
#include <sstream>
#include <utility>

#include "tools/program/hexadecimal.hpp"
#include "tools/program/joined.hpp"
#include "tools/program/table.hpp"
#include "tools/receive/frame_record.hpp"
#include "tools/receive/record_file.hpp"
#include "wire/byte_order.hpp"

namespace iog::tools {
namespace {

constexpr const char* kClassHeading =
    "# frame stamp_us slices packets_placed packets_not_placed causes corner_a corner_b tiles "
    "class_crc frames_of_time poses_used slice_poses";

// By the fields of the wire that say where a slice was placed.
std::uint32_t name_of(const stream::SliceRecord& slice) {
  std::array<std::byte, 20> bytes{};
  const auto all = std::span(bytes);
  wire::store_be64(all.first<8>(), slice.middle_us);
  wire::store_be32(all.subspan<8, 4>(), static_cast<std::uint32_t>(slice.pose.x_mm));
  wire::store_be32(all.subspan<12, 4>(), static_cast<std::uint32_t>(slice.pose.y_mm));
  wire::store_be32(all.subspan<16, 4>(), slice.pose.heading);
  stream::Crc32 crc;
  crc.update(bytes);
  return crc.value();
}

std::vector<std::uint32_t> slice_poses_of(const ClassGrid& classes) {
  std::vector<std::uint32_t> names;
  if (classes.has_end) {
    std::ranges::transform(std::span(classes.end.slices).first(classes.end.slice_count),
                           std::back_inserter(names), name_of);
  }
  return names;
}

std::string list_of(const std::vector<std::uint32_t>& names) {
  return names.empty() ? "-" : joined(names, ",", [](std::uint32_t name) { return hex(name); });
}

// Nothing if it is not the list of what it holds.
std::optional<std::vector<std::uint32_t>> slice_poses_in(const std::string& list) {
  std::string numbers = list;
  std::ranges::replace(numbers, ',', ' ');
  std::istringstream in(numbers);
  in >> std::hex;
  std::vector<std::uint32_t> names(std::istream_iterator<std::uint32_t>(in), {});
  const bool is_list = names.size() <= stream::kMaxSlices && list_of(names) == list;
  return is_list ? std::optional(std::move(names)) : std::nullopt;
}

std::optional<ClassRecord> class_record_in(const std::string& line) {
  ClassRecord record;
  std::string poses_text;
  std::istringstream text(line);
  text >> record.number >> record.stamp_us >> record.slices >> record.packets_placed >>
      record.packets_not_placed >> std::hex >> record.causes >> std::dec >> record.corner_a >>
      record.corner_b >> record.tiles >> std::hex >> record.class_crc >> std::dec >>
      record.frames_of_time >> record.poses_used >> poses_text;
  auto slice_poses = slice_poses_in(poses_text);
  if (text.fail() || !slice_poses) {
    return std::nullopt;
  }
  record.slice_poses = *std::move(slice_poses);
  return record;
}

std::string place_of(const ClassRecord& record) {
  return counted(record.slices, "slice|slices up to ") + std::to_string(record.stamp_us) +
         " us, packets placed " + std::to_string(record.packets_placed) + ", not placed " +
         std::to_string(record.packets_not_placed);
}

std::string grid_of(const ClassRecord& record) {
  return hex(record.class_crc) + " (" + counted(record.tiles, "tile|tiles from ") +
         std::to_string(record.corner_a) + ", " + std::to_string(record.corner_b) + ")";
}

// Where only poses come for two periods, a frame without evidence is over and ages the window.
std::string words_of_time(const ClassRecord& received, const ClassRecord& expected) {
  if (received.frames_of_time == expected.frames_of_time) {
    return {};
  }
  return "; until then the window's time went on in " +
         counted(received.frames_of_time, "frame|frames without evidence, expected ") +
         std::to_string(expected.frames_of_time) + "; was the host stalled?";
}

// A target that closes a frame before all of its poses have come places slices by older ones.
std::string words_of_poses(const ClassRecord& received, const ClassRecord& expected) {
  if (received.poses_used >= expected.poses_used) {
    return {};
  }
  return "; until then " + counted(received.poses_used, "pose|poses had come, of ") +
         std::to_string(expected.poses_used) + ": the others came late; was the host stalled?";
}

// "slices 3 to 6 of 6", counted from 1: the first and the last by another pose.
std::string slices_of_other_pose(const ClassRecord& received, const ClassRecord& expected) {
  const auto& one = received.slice_poses;
  const auto& other = expected.slice_poses;
  const auto first = std::ranges::mismatch(one, other).in1 - one.begin() + 1;
  const auto last =
      one.rend() - std::mismatch(one.rbegin(), one.rend(), other.rbegin(), other.rend()).first;
  return "slices " + std::to_string(first) + " to " + std::to_string(last) + " of " +
         std::to_string(one.size());
}

}  // namespace

ClassRecord class_record_of(const GridFrame& frame, std::uint32_t frames_of_time) {
  const ClassGrid& classes = *frame.classes;
  const bool is_verified = classes.is_whole() && !classes.is_damaged;
  return {.number = frame.evidence_number,
          .stamp_us = classes.window.slices_end_us,
          .slices = classes.window.slices,
          .packets_placed = classes.end.packets_placed,
          .packets_not_placed = classes.end.packets_not_placed,
          .causes = classes.window.causes,
          .corner_a = classes.window.corner_a,
          .corner_b = classes.window.corner_b,
          .tiles = static_cast<std::uint32_t>(classes.known_tiles.count()),
          .class_crc = is_verified ? classes.end.classes_crc : class_crc_of(classes),
          .frames_of_time = frames_of_time,
          .poses_used = classes.end.pose_fates[static_cast<std::size_t>(pose::Fate::kUsed)],
          .slice_poses = slice_poses_of(classes)};
}

std::string line_of(const ClassRecord& record) {
  std::ostringstream text;
  text << record.number << ' ' << record.stamp_us << ' ' << record.slices << ' '
       << record.packets_placed << ' ' << record.packets_not_placed << ' ' << std::hex
       << record.causes << std::dec << ' ' << record.corner_a << ' ' << record.corner_b << ' '
       << record.tiles << ' ' << hex(record.class_crc) << ' ' << record.frames_of_time << ' '
       << record.poses_used << ' ' << list_of(record.slice_poses);
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
             "; expected " + place_of(expected[i]) + words_of_poses(received[i], expected[i]);
    }
    if (!received[i].has_same_poses(expected[i])) {
      const bool is_same_input = received[i].poses_used == expected[i].poses_used;
      return name + ": " + slices_of_other_pose(received[i], expected[i]) +
             (is_same_input ? " were placed elsewhere by the same poses"
                            : " were placed by other poses") +
             words_of_poses(received[i], expected[i]);
    }
    if (!received[i].has_same_classes(expected[i])) {
      return name + ": same slices, other classes: received " + grid_of(received[i]) +
             ", expected " + grid_of(expected[i]) + words_of_time(received[i], expected[i]);
    }
  }
  if (received.size() != expected.size()) {
    return counted(received.size(), "frame|frames with evidence and classes received, ") +
           std::to_string(expected.size()) + " expected; the common ones are equal";
  }
  return std::nullopt;
}

}  // namespace iog::tools
