// iog fuse: the grids of a capture, by the target's own code, without a target.
#include <CLI/CLI.hpp>
#include <cstdint>
#include <iostream>
#include <memory>
#include <optional>
#include <string>
#include <utility>

#include "tools/commands/subcommands.hpp"
#include "tools/formats/capture/pcap_reader.hpp"
#include "tools/formats/picture/frame_writer.hpp"
#include "tools/fuse/offline_target.hpp"
#include "tools/fuse/stream_recorder.hpp"
#include "tools/program/exit_status.hpp"
#include "tools/program/file.hpp"
#include "tools/program/progress.hpp"
#include "tools/receive/frame_assembler.hpp"
#include "tools/receive/run_statistics.hpp"
#include "tools/vehicles/vehicle_catalogue.hpp"
#include "tools/vehicles/vehicle_fit.hpp"

namespace iog::tools {
namespace {

struct Options {
  std::string pcap;
  std::string vehicle = kDefaultVehicle;
  std::optional<std::uint64_t> frame;
  std::string out_raw;
  std::string hashes;
  std::string rule;
  std::string stream;
  PictureOptions pictures;
};

vehicle::Vehicle vehicle_with_rule(const CatalogueEntry& car, const std::string& rule) {
  vehicle::Vehicle vehicle = *car.vehicle;
  if (!rule.empty()) {
    vehicle.rule = rule == "bayes" ? vehicle::FusionRule::kBayes : vehicle::FusionRule::kHitsWin;
  }
  return vehicle;
}

// Keeps the frame that was asked for, or the last one with evidence.
class Chosen {
 public:
  explicit Chosen(std::optional<std::uint64_t> number) : number_(number) {}

  void offer(GridFrame&& frame) {
    if (frame.header.has_evidence() && (!number_ || frame.evidence_number == *number_)) {
      frame_ = std::move(frame);
    }
  }

  [[nodiscard]] const GridFrame& get(std::size_t count) const {
    if (!frame_) {
      throw UsageError(number_ ? "no frame " + std::to_string(*number_) + "; the capture has " +
                                     std::to_string(count) + " frames with evidence"
                               : "no frame has evidence");
    }
    return *frame_;
  }

 private:
  std::optional<std::uint64_t> number_;
  std::optional<GridFrame> frame_;
};

std::uint64_t feed(PcapReader& capture, const CatalogueEntry& car, OfflineTarget& target) {
  Progress progress("packets");
  std::uint64_t other_ports = 0;
  while (const std::optional<CapturedDatagram> datagram = capture.next()) {
    if (sensor_of_port(car, datagram->destination.port) < car.sensors.size()) {
      static_cast<void>(target.take(*datagram));
    } else {
      ++other_ports;
    }
    progress.show(capture.counts().datagrams);
  }
  target.finish();
  return other_ports;
}

void print_input(const PcapReader& capture, std::uint64_t other_ports) {
  std::cout << row("packets", std::to_string(capture.counts().datagrams - other_ports) +
                                  " for the sensors' ports, " + std::to_string(other_ports) +
                                  " for others");
  if (const std::string skipped = describe_skipped(capture.counts()); !skipped.empty()) {
    std::cout << row("not looked at", skipped);
  }
  if (capture.is_cut_off()) {
    std::cout << row("capture", "breaks off in a packet");
  }
}

void fuse(const Options& options) {
  const CatalogueEntry& car = find_vehicle(options.vehicle);
  const vehicle::Vehicle vehicle = vehicle_with_rule(car, options.rule);
  demand_fit(options.pcap, car);
  PcapReader capture(options.pcap);
  RunStatistics statistics;
  Chosen chosen(options.frame);
  FrameWriter pictures(options.pictures);
  FrameAssembler assembler([&](GridFrame&& frame) {
    statistics.add(frame);
    pictures.offer(frame);
    chosen.offer(std::move(frame));
  });
  std::optional<StreamRecorder> recorder;
  if (!options.stream.empty()) {
    recorder.emplace(options.stream);
  }
  const auto target =
      std::make_unique<OfflineTarget>(vehicle, [&](std::span<const std::byte> message) {
        assembler.take(message);
        if (recorder) {
          recorder->take(message);
        }
      });
  const std::uint64_t other_ports = feed(capture, car, *target);
  assembler.finish();
  if (recorder) {
    recorder->finish();
  }

  print_input(capture, other_ports);
  std::cout << statistics.table(false);
  if (!options.hashes.empty()) {
    write_records(options.hashes, statistics.records());
  }
  if (statistics.records().empty()) {
    throw CheckFailed(options.pcap + ": no frame has evidence: what came to the ports of " +
                      options.vehicle + " holds no scan of its sensors; `iog info " + options.pcap +
                      "` says what it is");
  }
  if (!options.out_raw.empty() || !options.pictures.folder.empty()) {
    const GridFrame& frame = chosen.get(statistics.records().size());
    pictures.write_last(frame);
    if (!options.out_raw.empty()) {
      OutputFile file(options.out_raw);
      file.write(std::as_bytes(frame.grid()));
      file.finish();
    }
  }
}

}  // namespace

void add_fuse(CLI::App& program) {
  auto* const command =
      program.add_subcommand("fuse", "Fuse a capture on this PC, with the target's own code");
  const auto options = std::make_shared<Options>();
  command->add_option("--pcap", options->pcap, "The capture to read (pcap or pcapng)")
      ->option_text("FILE  (required)")
      ->required();
  command->add_option("--vehicle", options->vehicle, vehicle_option_help())
      ->option_text("NAME  (default reference_car)");
  command
      ->add_option("--frame", options->frame,
                   "The frame to write, from 0 among those with evidence; else the last")
      ->option_text("N")
      ->check(CLI::NonNegativeNumber);
  command->add_option("--out-raw", options->out_raw, "Write its occupancy indexes as bytes")
      ->option_text("FILE");
  add_picture_options(*command, options->pictures);
  command->add_option("--rule", options->rule, "Fusion rule, instead of the vehicle's own")
      ->option_text("hits_win | bayes")
      ->check(CLI::IsMember({"hits_win", "bayes"}));
  command->add_option("--hashes", options->hashes, "Write one line per frame with evidence")
      ->option_text("FILE");
  command
      ->add_option("--stream", options->stream,
                   "Write the messages that the target would send, as a capture")
      ->option_text("FILE");
  command->footer(
      "The capture stands for its replay: sensors are told apart by destination port, their "
      "source\n"
      "addresses are not compared. Time is that of the capture; a pause counts as 1 s at most.\n"
      "--out-raw: 1024 x 1024 int8, row by row from the lowest y. --hashes: number, complete and\n"
      "partial sensors (hex), points used, tiles, grid CRC; the run hash is the CRC-32 of these "
      "CRCs.\n" +
      std::string(kPictureFooter));
  command->callback([options] { fuse(*options); });
}

}  // namespace iog::tools
