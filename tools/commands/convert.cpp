// iog convert: recordings that are no capture as one: raw messages, one file for each sensor, the
// point clouds of a data set, or packets in a bag of ROS 2.
#include <CLI/CLI.hpp>
#include <algorithm>
#include <iostream>
#include <iterator>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "tools/clouds/cloud_conversion.hpp"
#include "tools/commands/subcommands.hpp"
#include "tools/commands/vehicle_options.hpp"
#include "tools/formats/capture/made_capture.hpp"
#include "tools/formats/capture/pcap_writer.hpp"
#include "tools/formats/lux/raw_recording.hpp"
#include "tools/formats/ros/recorded_packets.hpp"
#include "tools/poses/pose_log.hpp"
#include "tools/program/add_option.hpp"
#include "tools/program/exit_status.hpp"
#include "tools/program/joined.hpp"
#include "tools/program/progress.hpp"
#include "tools/program/table.hpp"

namespace iog::tools {
namespace {

struct ConvertOptions {
  std::vector<std::string> raw;
  std::string kitti;
  std::string bag;
  std::string topic;
  std::vector<double> mount_m{0, 0};
  std::string vehicle = kDefaultVehicle;
  std::string out;
};

struct Input {
  std::string path;
  std::size_t sensor;
};

std::string names_of(const CatalogueEntry& car) {
  return joined(car.sensors, ", ", &description::SensorConfig::name);
}

Input input_of(const std::string& option, const std::string& text, const CatalogueEntry& car) {
  const std::size_t colon = text.rfind(':');
  if (colon == std::string::npos && car.sensors.size() == 1) {
    return {text, 0};
  }
  const std::string name = colon == std::string::npos ? "" : text.substr(colon + 1);
  const std::size_t sensor = sensor_of_name(car, name);
  if (sensor == car.sensors.size()) {
    throw UsageError(option + " " + text + ": give FILE:SENSOR with one of the sensors of " +
                     std::string(car.vehicle->name) + ": " + names_of(car));
  }
  return {text.substr(0, colon), sensor};
}

// FOLDER:SENSOR, or FOLDER of a car with one Velodyne.
Input cloud_input_of(const std::string& text, const CatalogueEntry& car) {
  const auto is_velodyne = [](const description::SensorConfig& sensor) {
    return velodyne_unit_of(sensor.format) != nullptr;
  };
  const std::size_t colon = text.rfind(':');
  if (colon != std::string::npos) {
    const std::size_t sensor = sensor_of_name(car, text.substr(colon + 1));
    if (sensor < car.sensors.size() && is_velodyne(car.sensors[sensor])) {
      return {text.substr(0, colon), sensor};
    }
  } else if (std::ranges::count_if(car.sensors, is_velodyne) == 1) {
    const auto only = std::ranges::find_if(car.sensors, is_velodyne);
    return {text, static_cast<std::size_t>(only - car.sensors.begin())};
  }
  throw UsageError("--kitti " + text + ": give FOLDER:SENSOR with a Velodyne of " +
                   std::string(car.vehicle->name) + ", whose sensors are " + names_of(car));
}

// "; not sent: 3 that are no number, ..."
std::string words_of(const PointFates& fates) {
  std::vector<std::string> words;
  remark(fates.not_finite, "that is|are no number", words);
  remark(fates.no_laser, "where no laser looks", words);
  remark(fates.out_of_range, "out of range", words);
  remark(fates.taken, "beside others of one firing", words);
  std::string text;
  for (const std::string& word : words) {
    text += (text.empty() ? "; not sent: " : ", ") + word;
  }
  return text;
}

void convert_clouds(const ConvertOptions& options) {
  const CatalogueEntry& car = find_vehicle(options.vehicle);
  const Input input = cloud_input_of(options.kitti, car);
  CloudConversion conversion(input.path, car, input.sensor, options.mount_m[0], options.mount_m[1]);
  Progress progress("clouds", conversion.set().clouds.size());
  std::optional<PcapWriter> capture;  // not before the first cloud is known to be one
  std::uint64_t datagrams = 0;
  for (std::vector<CapturedDatagram> next; !(next = conversion.next()).empty();) {
    if (!capture) {
      capture.emplace(options.out);
    }
    std::ranges::for_each(next, [&](const auto& datagram) { capture->write(datagram); });
    datagrams += next.size();
    progress.show(conversion.clouds_read());
  }
  if (!capture) {
    throw UsageError(input.path + ": there is no cloud in it");
  }
  capture->finish();
  const CloudSet& set = conversion.set();
  for (const std::string& remark : set.remarks) {
    std::cout << input.path << ": " << remark << '\n';
  }
  std::cout << input.path << ": " << counted(conversion.clouds_read(), "cloud|clouds") << ", "
            << (set.is_corrected ? "corrected for the car's motion, which is taken back"
                                 : "each point as the unit saw it")
            << '\n'
            << conversion.fates().sent << " of " << conversion.fates().seen() << " points sent by "
            << car.sensors[input.sensor].name << words_of(conversion.fates()) << '\n'
            << counted(datagrams - conversion.poses(), "packet|packets and ")
            << counted(conversion.poses(), "pose|poses in ") << options.out << '\n';
}

void convert_messages(const ConvertOptions& options) {
  const CatalogueEntry& car = find_vehicle(options.vehicle);
  std::vector<CapturedDatagram> datagrams;
  for (const std::string& text : options.raw) {
    const Input input = input_of("--raw", text, car);
    RawRecording recording = read_raw_recording(input.path, car, input.sensor);
    std::cout << input.path << ": " << counted(recording.datagrams.size(), "packet|packets of ")
              << car.sensors[input.sensor].name
              << (recording.remark.empty() ? "" : "; not used: " + recording.remark) << '\n';
    std::ranges::move(recording.datagrams, std::back_inserter(datagrams));
  }
  std::ranges::stable_sort(datagrams, {}, &CapturedDatagram::time_us);
  PcapWriter capture(options.out);
  Progress progress("packets", datagrams.size());
  std::uint64_t written = 0;
  for (const CapturedDatagram& datagram : datagrams) {
    capture.write(datagram);
    progress.show(++written);
  }
  capture.finish();
  const std::uint64_t span_us = datagrams.back().time_us - datagrams.front().time_us;
  std::cout << counted(datagrams.size(), "packet|packets over ") << span_us / 1000 << " ms in "
            << options.out << '\n';
}

// Of a driver's recording, each with the time at which it came.
void convert_packets(const ConvertOptions& options) {
  const CatalogueEntry& car = find_vehicle(options.vehicle);
  const Input input = input_of("--bag", options.bag, car);
  const description::SensorConfig& sensor = car.sensors[input.sensor];
  const std::uint32_t source = sensor.source_ipv4 != 0 ? sensor.source_ipv4 : kUnnamedIpv4;
  std::optional<PcapWriter> capture;  // not before the first packet is known to be one
  Progress progress("packets");
  std::uint64_t packets = 0;
  std::uint64_t too_long = 0;
  auto remarks = ros::for_each_packet(
      input.path, options.topic, [&](std::uint64_t time_us, std::span<const std::byte> payload) {
        if (payload.size() > PcapWriter::kMaxPayloadBytes) {
          ++too_long;
          return;
        }
        if (!capture) {
          capture.emplace(options.out);
        }
        capture->write({.time_us = time_us,
                        .source = {source, sensor.udp_port},
                        .destination = {kTargetIpv4, sensor.udp_port},
                        .payload = {payload.begin(), payload.end()}});
        progress.show(++packets);
      });
  if (!capture) {
    throw UsageError(input.path + ": all its packets are longer than a UDP datagram");
  }
  capture->finish();
  remark(too_long, "packet|packets longer than a UDP datagram was|were not sent", remarks);
  for (const std::string& remark : remarks) {
    std::cout << remark << '\n';
  }
  std::cout << counted(packets, "packet|packets of ") << sensor.name << " in " << options.out
            << '\n';
}

}  // namespace

void add_convert(CLI::App& program) {
  auto* const command = program.add_subcommand(
      "convert", "Make a capture from raw messages, KITTI clouds and poses, or packets in a bag");
  const auto options = std::make_shared<ConvertOptions>();
  auto* const raw = add_option(*command, "--raw", "FILE:SENSOR", options->raw,
                               "Raw recording and its sensor, by name or number; may be repeated")
                        ->take_all();
  auto* const kitti = add_option(*command, "--kitti", "FOLDER[:SENSOR]", options->kitti,
                                 "Folder of KITTI raw or odometry data, for the car's Velodyne")
                          ->excludes(raw);
  auto* const bag =
      add_option(*command, "--bag", "FILE | FOLDER[:SENSOR]", options->bag,
                 "Recording of ROS 2 with packets of velodyne_msgs, nebula_msgs or pandar_msgs")
          ->excludes(raw)
          ->excludes(kitti);
  add_option(*command, "--topic", "TOPIC  (default the one with packets)", options->topic,
             "Topic of the recording")
      ->needs(bag);
  add_option(*command, "--mount", "X Y  (metres, default 0 0)", options->mount_m,
             "Position of the receiver of KITTI's raw data in the vehicle frame")
      ->expected(2)
      ->needs(kitti);
  add_vehicle_options(*command, options->vehicle);
  add_option(*command, "--out", "FILE  (required)", options->out, "Capture to write (.pcap)")
      ->required();
  command->footer(
      "A raw recording consists of ibeo 0x2202 messages of a LUX, or of Velodyne payloads of 1206 "
      "bytes.\n"
      "Packets are sorted by the sensors' own times. A LUX message longer than a datagram of 1400 "
      "bytes is split into several with the same scan number, each with its own sector. A KITTI "
      "folder contains velodyne_points and oxts (raw data), or velodyne, times.txt, poses.txt and "
      "calib.txt (odometry, SemanticKITTI). Each point is assigned to the laser that looks in its "
      "direction, by the car's table, and to the nearest firing. Poses are sent 100 times per "
      "second (docs/recordings.md).");
  command->callback([options] {
    if (!options->bag.empty()) {
      convert_packets(*options);
    } else if (!options->kitti.empty()) {
      convert_clouds(*options);
    } else if (!options->raw.empty()) {
      convert_messages(*options);
    } else {
      throw UsageError("give --raw FILE:SENSOR, --kitti FOLDER or --bag FOLDER");
    }
  });
}

}  // namespace iog::tools
