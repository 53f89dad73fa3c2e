#include "tools/formats/ros/recorded_packets.hpp"

#include <algorithm>
#include <array>

#include "tools/formats/ros/cdr_reader.hpp"
#include "tools/formats/ros/recorded_messages.hpp"
#include "tools/program/exit_status.hpp"
#include "tools/program/joined.hpp"
#include "tools/program/printable.hpp"

namespace iog::tools::ros {
namespace {

constexpr std::string_view kVelodyne = "velodyne_msgs/msg/VelodyneScan";
constexpr std::string_view kNebula = "nebula_msgs/msg/NebulaPackets";
constexpr std::array kTypes{kVelodyne, kNebula, std::string_view("pandar_msgs/msg/PandarScan")};

// uint8[1206] of a Velodyne, uint8[] of Nebula, uint8[1500] of a Pandar with the size behind it.
std::span<const std::byte> payload_in(CdrReader& in, std::string_view type) {
  constexpr std::size_t kVelodyneBytes = 1206;
  constexpr std::size_t kPandarBytes = 1500;
  if (type == kNebula) {
    return in.sequence(1);
  }
  const auto bytes = in.array(type == kVelodyne ? kVelodyneBytes : kPandarBytes);
  return type == kVelodyne ? bytes : bytes.first(std::min<std::size_t>(in.u32(), bytes.size()));
}

}  // namespace

std::vector<std::string> for_each_packet(
    const std::string& path, std::string_view topic,
    const std::function<void(std::uint64_t, std::span<const std::byte>)>& take) {
  std::string its(topic);
  bool has_packet = false;
  const auto take_message = [&](const RecordedMessage& message) {
    its = its.empty() ? std::string(message.topic) : its;
    if (message.topic != its) {
      throw UsageError(path + ": " + printable(its) + " and " +
                       printable(std::string(message.topic)) +
                       " have packets: choose one by --topic");
    }
    CdrReader in(message.data, message.where);
    static_cast<void>(in.stamp_us());
    static_cast<void>(in.text());
    for (std::uint32_t left = in.u32(); left > 0; --left) {
      const std::uint64_t time_us = in.stamp_us();
      const auto payload = payload_in(in, message.type);
      in.must_be_whole();
      take(time_us, payload);
      has_packet = true;
    }
  };
  std::vector<std::string> remarks = for_each_message(path, kTypes, topic, take_message);
  if (!has_packet) {
    throw UsageError(path + ": it has no packets of velodyne_msgs, nebula_msgs or pandar_msgs" +
                     (topic.empty() ? "" : " on " + std::string(topic)) +
                     (remarks.empty() ? "" : "; " + joined(remarks, "; ")) +
                     "; `iog points` reads clouds");
  }
  return remarks;
}

}  // namespace iog::tools::ros
