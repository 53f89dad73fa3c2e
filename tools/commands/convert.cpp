// iog convert: recordings of raw messages, one file for each sensor, as one capture.
#include <CLI/CLI.hpp>
#include <algorithm>
#include <iostream>
#include <iterator>
#include <memory>
#include <string>
#include <vector>

#include "tools/commands/subcommands.hpp"
#include "tools/commands/vehicle_options.hpp"
#include "tools/formats/capture/pcap_writer.hpp"
#include "tools/formats/lux/raw_recording.hpp"
#include "tools/program/exit_status.hpp"

namespace iog::tools {
namespace {

struct ConvertOptions {
  std::vector<std::string> raw;
  std::string vehicle = kDefaultVehicle;
  std::string out;
};

struct Input {
  std::string path;
  std::size_t sensor;
};

std::string names_of(const CatalogueEntry& car) {
  std::string names;
  for (const description::SensorConfig& sensor : car.sensors) {
    names += (names.empty() ? "" : ", ") + std::string(sensor.name);
  }
  return names;
}

Input input_of(const std::string& text, const CatalogueEntry& car) {
  const std::size_t colon = text.rfind(':');
  if (colon == std::string::npos && car.sensors.size() == 1) {
    return {text, 0};
  }
  const std::string name = colon == std::string::npos ? "" : text.substr(colon + 1);
  const std::size_t sensor = sensor_of_name(car, name);
  if (sensor == car.sensors.size()) {
    throw UsageError("--raw " + text + ": give FILE:SENSOR with one of the sensors of " +
                     std::string(car.vehicle->name) + ": " + names_of(car));
  }
  return {text.substr(0, colon), sensor};
}

void convert(const ConvertOptions& options) {
  const CatalogueEntry& car = find_vehicle(options.vehicle);
  std::vector<CapturedDatagram> datagrams;
  for (const std::string& text : options.raw) {
    const Input input = input_of(text, car);
    RawRecording recording = read_raw_recording(input.path, car, input.sensor);
    std::cout << input.path << ": " << recording.datagrams.size() << " packets of "
              << car.sensors[input.sensor].name
              << (recording.remark.empty() ? "" : "; not used: " + recording.remark) << '\n';
    std::ranges::move(recording.datagrams, std::back_inserter(datagrams));
  }
  std::ranges::stable_sort(datagrams, {}, &CapturedDatagram::time_us);
  PcapWriter capture(options.out);
  for (const CapturedDatagram& datagram : datagrams) {
    capture.write(datagram);
  }
  capture.finish();
  const std::uint64_t span_us = datagrams.back().time_us - datagrams.front().time_us;
  std::cout << datagrams.size() << " packets over " << span_us / 1000 << " ms in " << options.out
            << '\n';
}

}  // namespace

void add_convert(CLI::App& program) {
  auto* const command = program.add_subcommand(
      "convert", "Make a capture of raw messages that were recorded sensor by sensor");
  const auto options = std::make_shared<ConvertOptions>();
  command
      ->add_option("--raw", options->raw,
                   "A recording and its sensor, by name or number; once for each")
      ->option_text("FILE:SENSOR  (required)")
      ->required()
      ->take_all();
  add_vehicle_options(*command, options->vehicle);
  command->add_option("--out", options->out, "The capture to write (.pcap)")
      ->option_text("FILE  (required)")
      ->required();
  command->footer(
      "A recording is, back to back, ibeo 0x2202 messages of a LUX or Velodyne payloads of 1206 "
      "bytes.\n"
      "Packets are put in order of the sensors' own times. A LUX message that is longer than a\n"
      "datagram of 1400 bytes becomes several of the same scan number, each with its own sector.");
  command->callback([options] { convert(*options); });
}

}  // namespace iog::tools
