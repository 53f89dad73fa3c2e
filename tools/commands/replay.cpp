// iog replay: a capture on its way to a target, packet by packet, in its own time.
#include <CLI/CLI.hpp>
#include <algorithm>
#include <chrono>
#include <cstdint>
#include <iostream>
#include <memory>
#include <numeric>
#include <optional>
#include <random>
#include <set>
#include <string>
#include <thread>
#include <utility>
#include <vector>

#include "tools/commands/signing_options.hpp"
#include "tools/commands/subcommands.hpp"
#include "tools/commands/vehicle_options.hpp"
#include "tools/formats/capture/capture_clock.hpp"
#include "tools/identity/capture_identity.hpp"
#include "tools/identity/car_capture.hpp"
#include "tools/map/block_file.hpp"
#include "tools/program/add_option.hpp"
#include "tools/program/exit_status.hpp"
#include "tools/program/interrupt.hpp"
#include "tools/program/number_checks.hpp"
#include "tools/program/progress.hpp"
#include "tools/program/table.hpp"
#include "tools/replay/frame_grouper.hpp"
#include "tools/replay/map_sender.hpp"
#include "tools/replay/pace.hpp"
#include "tools/replay/pose_rounds.hpp"
#include "tools/replay/udp_sender.hpp"
#include "tools/vehicles/network_words.hpp"
#include "tools/vehicles/vehicle_catalogue.hpp"

namespace iog::tools {
namespace {

struct ReplayOptions {
  DriveFiles drive;
  std::string vehicle = kDefaultVehicle;
  std::string target;
  std::uint16_t port_base = 0;  // 0: the vehicle's own ports
  std::optional<double> speed;
  bool step = false;
  bool loop = false;
  std::string map;
  SigningOptions signing;
};

// Where nobody says more, the target of the vehicle's own description; with --port-base a PC's own
// QEMU.
std::string target_of(const ReplayOptions& options, const CatalogueEntry& car) {
  if (!options.target.empty()) {
    return options.target;
  }
  return options.port_base != 0 ? "127.0.0.1" : dotted(car.network->address.value);
}

std::vector<std::uint16_t> target_ports(const ReplayOptions& options,
                                        std::vector<std::uint16_t> ports) {
  if (options.port_base == 0) {
    return ports;
  }
  if (std::size_t{options.port_base} + ports.size() > 0x10000) {
    throw UsageError("--port-base leaves no room for " + std::to_string(ports.size()) +
                     " ports; give a lower one");
  }
  std::iota(ports.begin(), ports.end(), options.port_base);
  return ports;
}

class Replay {
 public:
  explicit Replay(const ReplayOptions& options)
      : options_(&options),
        car_(&find_vehicle(options.vehicle)),
        ports_(ports_of(*car_)),
        poses_(options.loop ? rounds_before() : 0),
        signer_(signer_of(options.signing)),
        sender_(target_of(options, *car_), target_ports(options, ports_)),
        pace_(options.speed.value_or(options.step ? 0.0 : 1.0)),
        progress_("packets") {
    if (options.loop && std::ranges::count(options.drive.captures, "-") > 0) {
      throw UsageError("--loop reads a capture again and again: give a file, not -");
    }
    demand_fit(options.drive.captures, *car_);
  }

  void run() {
    if (!car_->key_file.empty() && options_->signing.key.empty()) {
      std::cerr
          << "warning: " << options_->vehicle
          << " has a key (authentication): without --key, a target drops all poses and maps\n";
    }
    send_map();
    do {
      CarCapture capture(options_->drive, *car_);
      const std::uint64_t tried_before = sent_ + refused_;
      options_->step ? play_stepwise(capture) : play(capture);
      sender_.demand_sent();
      if (sent_ + refused_ == tried_before && !was_interrupted() && !has_stopped_) {
        throw UsageError(options_->drive.name() + ": no packet for a sensor of " +
                         options_->vehicle);
      }
    } while (options_->loop && !was_interrupted() && !has_stopped_);
  }

  void print_counts() const {
    std::cout << counted(sent_, "packet|packets, ") << bytes_ << " bytes sent";
    if (options_->step) {
      std::cout << " in " << counted(frames_, "frame|frames");
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
  // The next datagram that the vehicle has a port for.
  std::optional<CapturedDatagram> next_of(CarCapture& capture) {
    while (std::optional<CapturedDatagram> datagram = capture.next()) {
      if (is_pose_port(*car_, datagram->destination.port)) {
        datagram->payload = poses_.in_round(std::move(datagram->payload));
        return datagram;
      }
      if (takes_port(*car_, datagram->destination.port)) {
        return datagram;
      }
      ++other_ports_;
    }
    for (const CaptureSet::File& file : capture.files().files()) {
      skipped_ += file.reader->counts().skipped();
    }
    warn_of(options_->drive, capture);
    return std::nullopt;
  }

  [[nodiscard]] std::vector<std::byte> as_sent(const CapturedDatagram& datagram) {
    if (is_pose_port(*car_, datagram.destination.port)) {
      return signer_.as_sent(pose::kPoseChannel, datagram.payload);
    }
    return is_map_port(*car_, datagram.destination.port)
               ? signer_.as_sent(map::kMapChannel, datagram.payload)
               : datagram.payload;
  }

  void send(const CapturedDatagram& datagram, const CarCapture& capture) {
    last_time_us_ = clock_.move_to(datagram.time_us) + time_offset_;
    pace_.wait_for(last_time_us_);
    const auto port = std::ranges::find(ports_, datagram.destination.port);
    if (sender_.send(static_cast<std::size_t>(port - ports_.begin()), as_sent(datagram))) {
      ++sent_;
      bytes_ += datagram.payload.size();
    } else {
      ++refused_;
    }
    last_sent_ = std::chrono::steady_clock::now();
    are_poses_on_the_way_ = is_pose_port(*car_, datagram.destination.port);
    ports_on_the_way_.insert(datagram.destination.port);
    progress_.show(sent_, options_->loop ? std::nullopt : capture.files().part_read());
  }

  // Twice, because nobody says what has arrived. Classes are named as soon as the target uses it.
  void send_map() {
    const auto port = std::ranges::find(ports_, car_->vehicle->maps.udp_port);
    if (options_->map.empty()) {
      return;
    }
    if (port == ports_.end()) {
      throw UsageError("--map: " + options_->vehicle + " has no classes, so it has no use for one");
    }
    const std::vector<std::uint8_t> block = read_block(options_->map);
    MapSender map(block, sender_, static_cast<std::size_t>(port - ports_.begin()), signer_);
    for (int round = 0; round < 2; ++round) {
      refused_ += map.send_all(kChunksPerSecond);
    }
    std::cout << counted(map.chunks(), "chunk|chunks of ") << options_->map << " sent twice"
              << std::endl;
  }

  void play(CarCapture& capture) {
    start_round();
    while (const auto datagram = next_of(capture)) {
      if (was_interrupted()) {
        return;
      }
      send(*datagram, capture);
    }
  }

  void play_stepwise(CarCapture& capture) {
    start_round();
    FrameGrouper grouper(*car_->vehicle, [&] { return next_of(capture); });
    std::vector<CapturedDatagram> frame = grouper.next();
    while (!frame.empty() && !was_interrupted()) {
      for (const CapturedDatagram& datagram : frame) {
        let_other_kind_arrive(is_pose_port(*car_, datagram.destination.port));
        send(datagram, capture);
        let_packets_arrive(datagram);
      }
      const bool has_packets = has_sensor_packet(frame);
      if (has_packets) {
        std::cout << "frame " << frames_++ << " sent" << std::endl;
      }
      frame = grouper.next();
      if (has_packets && (options_->loop || !frame.empty()) && !wait_for_line()) {
        has_stopped_ = true;
        return;
      }
    }
  }

  // A target takes the hour of a packet's time from the newest pose, and closes a frame with its
  // last packet: the poses before a packet must be there by then, and those behind it not yet. What
  // goes to different ports may overtake one another: QEMU looks at them in an order of its own. So
  // on this PC they have to be read first; others have the time that a wire takes.
  void let_other_kind_arrive(bool is_pose) {
    constexpr std::chrono::milliseconds kOnTheWay{5};
    if (is_pose == are_poses_on_the_way_ || ports_on_the_way_.empty()) {
      return;
    }
    if (!wait_until_taken(ports_on_the_way_)) {
      std::this_thread::sleep_until(last_sent_ + kOnTheWay);
    }
    ports_on_the_way_.clear();
  }

  // As fast as it goes would be faster than a program on this PC reads: a port of Linux holds
  // 212,992 bytes of memory by default, 90 packets of a Velodyne.
  void let_packets_arrive(const CapturedDatagram& datagram) {
    constexpr std::uint64_t kAtOnce = 16;
    if (sent_ % kAtOnce == 0 && options_->speed.value_or(0) <= 0 && is_of_sensor(datagram)) {
      static_cast<void>(wait_until_taken({datagram.destination.port}));
    }
  }

  // Until whoever listens to the ports on this PC has read all of it, or does not for a second.
  // False if nobody knows.
  bool wait_until_taken(const std::set<std::uint16_t>& ports) const {
    constexpr std::chrono::seconds kPatience{1};
    constexpr std::chrono::microseconds kPause{200};
    const auto end = std::chrono::steady_clock::now() + kPatience;
    for (const std::uint16_t port : ports) {
      const auto index = static_cast<std::size_t>(std::ranges::find(ports_, port) - ports_.begin());
      std::optional<bool> taken = sender_.has_been_taken(index);
      while (taken == false && !was_interrupted() && std::chrono::steady_clock::now() < end) {
        std::this_thread::sleep_for(kPause);
        taken = sender_.has_been_taken(index);
      }
      if (!taken) {
        return false;
      }
    }
    return true;
  }

  // The last poses of a capture are behind its last frame, and nobody answers to them.
  [[nodiscard]] bool has_sensor_packet(const std::vector<CapturedDatagram>& frame) const {
    return std::ranges::any_of(
        frame, [this](const CapturedDatagram& datagram) { return is_of_sensor(datagram); });
  }

  [[nodiscard]] bool is_of_sensor(const CapturedDatagram& datagram) const {
    return sensor_of_port(*car_, datagram.destination.port) < car_->sensors.size();
  }

  // False: there will be no more. That the receiver listens, or hears the target, is no notice of a
  // frame.
  static bool wait_for_line() {
    std::string line;
    do {
      if (!std::getline(std::cin, line)) {
        return false;
      }
    } while (line == "listening" || line == "heard");
    return true;
  }

  // A target may have heard this recording already, and forgets none of the runs that it heard.
  static std::uint32_t rounds_before() {
    constexpr std::uint32_t kMost = 0x7FFF;
    return std::random_device()() % kMost + 1;
  }

  // Another round begins one frame after the last one's end.
  void start_round() {
    time_offset_ = sent_ == 0 ? 0 : last_time_us_ + car_->vehicle->frame_period_us;
    clock_ = CaptureClock();
    poses_.start_round();
  }

  const ReplayOptions* options_;
  const CatalogueEntry* car_;
  std::vector<std::uint16_t> ports_;
  PoseRounds poses_;
  std::set<std::uint16_t> ports_on_the_way_;  // whose datagrams the target may not have yet
  bool are_poses_on_the_way_ = false;
  std::chrono::steady_clock::time_point last_sent_;
  CommandSigner signer_;
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
  const auto options = std::make_shared<ReplayOptions>();
  add_drive_options(*command, *command, options->drive, kCapturesHelp)->required();
  add_vehicle_options(*command, options->vehicle);
  add_option(*command, "--target", "ADDRESS  (default the car's; with --port-base 127.0.0.1)",
             options->target, "IPv4 address to send to");
  add_option(*command, "--port-base", "PORT", options->port_base,
             "First of consecutive ports that replace the car's: of its sensors, then of "
             "poses and maps")
      ->check(CLI::Range(1, 65'535));
  add_option(*command, "--speed", "X  (default 1; with --step 0)", options->speed,
             "Speed: 1 as recorded, 2 twice as fast, 0 as fast as possible")
      ->check(not_below_zero());
  command->add_flag("--step", options->step,
                    "Report each frame as sent, then wait for a line on standard input");
  add_option(*command, "--map", "FILE", options->map, "Send this map first (.iogmap)");
  add_signing_options(*command, options->signing);
  add_listening_options(*command, options->signing);
  command->add_flag("--loop", options->loop, "Restart at the end, until interrupted");
  command->footer(
      "--step waits for Enter, or for the output of `iog receive --notify` on standard input. A "
      "pause of the capture lasts at most 1 s. With --loop, a capture should be longer than 30 "
      "frames, because a target drops repeated packets as duplicates. Each lap restarts the pose "
      "source.");
  command->callback([options] {
    catch_interrupts();
    Replay replay(*options);
    replay.run();
    replay.print_counts();
  });
}

}  // namespace iog::tools
