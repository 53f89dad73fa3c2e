// iog simulate: a drive that never was, as the capture that its scanners would have sent.
#include <CLI/CLI.hpp>
#include <algorithm>
#include <cstdint>
#include <iostream>
#include <memory>
#include <string>

#include "tools/commands/subcommands.hpp"
#include "tools/formats/capture/pcap_writer.hpp"
#include "tools/program/file.hpp"
#include "tools/program/progress.hpp"
#include "tools/simulate/drive.hpp"
#include "tools/simulate/truth.hpp"
#include "tools/vehicles/vehicle_catalogue.hpp"

namespace iog::tools {
namespace {

struct Options {
  std::uint64_t seed = 1;
  std::uint32_t seconds = 10;
  std::string out;
  std::string truth;
  std::uint32_t truth_every = 25;
  std::string vehicle = kDefaultVehicle;
  std::string scene = kDefaultScene;
};

void simulate(const Options& options) {
  const CatalogueEntry& car = find_vehicle(options.vehicle);
  Drive drive(car, options.seed, options.seconds, find_scene(options.scene));
  PcapWriter capture(options.out);
  if (!options.truth.empty()) {
    make_folder(options.truth);
  }
  Progress progress("frames", drive.frame_count());
  std::uint64_t datagrams = 0;
  std::uint64_t bytes = 0;
  for (std::uint32_t frame = 0; frame < drive.frame_count(); ++frame) {
    drive.move_to(frame);
    for (const CapturedDatagram& datagram : drive.datagrams()) {
      capture.write(datagram);
      ++datagrams;
      bytes += datagram.payload.size();
    }
    if (!options.truth.empty() && frame % options.truth_every == 0) {
      write_truth(numbered(options.truth, "truth", frame, ".pgm"),
                  true_occupancy(drive.ego(), drive.solids(), *car.description));
    }
    progress.show(frame + 1);
  }
  capture.finish();
  std::cout << drive.frame_count() << " frames, " << datagrams << " packets, " << bytes
            << " bytes of scans in " << options.out << '\n';
}

}  // namespace

void add_simulate(CLI::App& program) {
  auto* const command = program.add_subcommand(
      "simulate", "Make up a drive and write what the car's scanners send as a capture");
  const auto options = std::make_shared<Options>();
  command->add_option("--out", options->out, "The capture to write (.pcap)")
      ->option_text("FILE  (required)")
      ->required();
  command->add_option("--seed", options->seed, "Another seed, another world")
      ->option_text("N  (default 1)")
      ->check(CLI::NonNegativeNumber);
  command->add_option("--seconds", options->seconds, "Length of the drive, 25 frames a second")
      ->option_text("N  (1 to 600, default 10)")
      ->check(CLI::Range(1U, Drive::kMaxSeconds));
  command->add_option("--scene", options->scene, scene_option_help())
      ->option_text("NAME  (default city)");
  command->add_option("--vehicle", options->vehicle, vehicle_option_help())
      ->option_text("NAME  (default reference_car)");
  command
      ->add_option("--truth", options->truth, "Write the true occupancy there, as truth_NNNNNN.pgm")
      ->option_text("FOLDER");
  command->add_option("--truth-every", options->truth_every, "Write it for every Nth frame")
      ->option_text("N  (default 25)")
      ->check(CLI::PositiveNumber);
  command->footer(
      "The true occupancy has 1024 x 1024 cells of 0.1 m around the car, x to the right, y up: 0 "
      "where\n"
      "the cell's centre is covered by something within the vehicle's height band, 255 elsewhere.\n"
      "The same scene, seed, length and vehicle give the same bytes on every machine.\n"
      "Only ibeo LUX scanners are simulated.");
  command->callback([options] { simulate(*options); });
}

}  // namespace iog::tools
