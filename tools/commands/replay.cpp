// iog replay: a capture on its way to a target, packet by packet, in its own time.
#include <CLI/CLI.hpp>
#include <cstdint>
#include <iostream>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "tools/commands/subcommands.hpp"
#include "tools/formats/capture/capture_clock.hpp"
#include "tools/formats/capture/pcap_reader.hpp"
#include "tools/program/exit_status.hpp"
#include "tools/program/interrupt.hpp"
#include "tools/program/progress.hpp"
#include "tools/replay/frame_grouper.hpp"
#include "tools/replay/pace.hpp"
#include "tools/replay/udp_sender.hpp"
#include "tools/vehicles/vehicle_catalogue.hpp"
#include "tools/vehicles/vehicle_fit.hpp"

namespace iog::tools {
namespace {

struct Options {
  std::string pcap;
  std::string vehicle = kDefaultVehicle;
  std::string target = "127.0.0.1";
  std::uint16_t port_base = 0;
  std::optional<double> speed;
  bool step = false;
  bool loop = false;
};

class Replay {
 public:
  explicit Replay(const Options& options)
      : options_(&options),
        car_(&find_vehicle(options.vehicle)),
        sender_(options.target, options.port_base),
        pace_(options.speed.value_or(options.step ? 0.0 : 1.0)),
        progress_("packets") {
    if (std::size_t{options.port_base} + car_->sensors.size() > 0x10000) {
      throw UsageError("--port-base leaves no room for " + std::to_string(car_->sensors.size()) +
                       " ports; give a lower one");
    }
    demand_fit(options.pcap, *car_);
  }

  void run() {
    do {
      PcapReader capture(options_->pcap);
      const std::uint64_t sent_before = sent_;
      options_->step ? play_stepwise(capture) : play(capture);
      if (sent_ == sent_before && !was_interrupted() && !has_stopped_) {
        throw UsageError(options_->pcap + ": no packet for a sensor of " + options_->vehicle);
      }
    } while (options_->loop && !was_interrupted() && !has_stopped_);
  }

  void print_counts() const {
    std::cout << sent_ << " packets, " << bytes_ << " bytes sent";
    if (options_->step) {
      std::cout << " in " << frames_ << " frames";
    }
    std::cout << "; " << refused_ << " refused by the system, " << other_ports_
              << " for other ports, " << skipped_ << " skipped; worst delay "
              << pace_.worst_delay_us() << " us\n";
    if (has_stopped_) {
      throw CheckFailed("standard input ended after frame " + std::to_string(frames_ - 1) +
                        ": the capture was not sent to its end");
    }
  }

 private:
  std::optional<CapturedDatagram> next_of_sensor(PcapReader& capture) {
    while (std::optional<CapturedDatagram> datagram = capture.next()) {
      if (sensor_of_port(*car_, datagram->destination.port) < car_->sensors.size()) {
        return datagram;
      }
      ++other_ports_;
    }
    skipped_ += capture.counts().skipped();
    return std::nullopt;
  }

  void send(const CapturedDatagram& datagram) {
    last_time_us_ = clock_.move_to(datagram.time_us) + time_offset_;
    pace_.wait_for(last_time_us_);
    const std::size_t sensor = sensor_of_port(*car_, datagram.destination.port);
    if (sender_.send(sensor, datagram.payload)) {
      ++sent_;
      bytes_ += datagram.payload.size();
    } else {
      ++refused_;
    }
    progress_.show(sent_);
  }

  void play(PcapReader& capture) {
    start_round();
    while (const auto datagram = next_of_sensor(capture)) {
      if (was_interrupted()) {
        return;
      }
      send(*datagram);
    }
  }

  void play_stepwise(PcapReader& capture) {
    start_round();
    FrameGrouper grouper(*car_->vehicle, [&] { return next_of_sensor(capture); });
    std::vector<CapturedDatagram> frame = grouper.next();
    while (!frame.empty() && !was_interrupted()) {
      for (const CapturedDatagram& datagram : frame) {
        send(datagram);
      }
      ++frames_;
      frame = grouper.next();
      if ((options_->loop || !frame.empty()) && !wait_for_line()) {
        has_stopped_ = true;
        return;
      }
    }
  }

  // False: there will be no more. That the receiver listens is no notice of a frame.
  static bool wait_for_line() {
    std::string line;
    do {
      if (!std::getline(std::cin, line)) {
        return false;
      }
    } while (line == "listening");
    return true;
  }

  // Another round begins one frame after the last one's end.
  void start_round() {
    time_offset_ = sent_ == 0 ? 0 : last_time_us_ + car_->vehicle->frame_period_us;
    clock_ = CaptureClock();
  }

  const Options* options_;
  const CatalogueEntry* car_;
  UdpSender sender_;
  Pace pace_;
  Progress progress_;
  CaptureClock clock_;
  std::uint64_t time_offset_ = 0;
  std::uint64_t last_time_us_ = 0;
  std::uint64_t sent_ = 0;
  std::uint64_t bytes_ = 0;
  std::uint64_t refused_ = 0;
  std::uint64_t other_ports_ = 0;
  std::uint64_t skipped_ = 0;
  std::uint64_t frames_ = 0;
  bool has_stopped_ = false;
};

}  // namespace

void add_replay(CLI::App& program) {
  auto* const command =
      program.add_subcommand("replay", "Send the packets of a capture to a target");
  const auto options = std::make_shared<Options>();
  command->add_option("--pcap", options->pcap, "The capture to read (pcap or pcapng)")
      ->option_text("FILE  (required)")
      ->required();
  command->add_option("--vehicle", options->vehicle, vehicle_option_help())
      ->option_text("NAME  (default reference_car)");
  command->add_option("--target", options->target, "IPv4 address to send to")
      ->option_text("ADDRESS  (default 127.0.0.1)");
  command
      ->add_option("--port-base", options->port_base,
                   "UDP port of the vehicle's sensor 0, its next sensor's is the next")
      ->option_text("PORT  (required)")
      ->required()
      ->check(CLI::Range(1, 65'535));
  command
      ->add_option("--speed", options->speed,
                   "1: as recorded, 2: twice as fast, 0: as fast as it goes")
      ->option_text("X")
      ->check(CLI::NonNegativeNumber);
  command->add_flag("--step", options->step, "After each frame wait for a line on standard input");
  command->add_flag("--loop", options->loop, "Begin again at the end, until interrupted");
  command->footer(
      "--speed is 1, with --step 0. For --step press Enter, or let `iog receive --notify` write "
      "there.\n"
      "A pause of the capture lasts 1 s at most. With --loop a capture should be longer than 30\n"
      "frames: a target takes a repeated packet for a duplicate and drops it.");
  command->callback([options] {
    catch_interrupts();
    Replay replay(*options);
    replay.run();
    replay.print_counts();
  });
}

}  // namespace iog::tools
