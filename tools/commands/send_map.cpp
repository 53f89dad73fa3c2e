// iog send-map: a map block on its way to a target, until the target says that it uses it.
#include <CLI/CLI.hpp>
#include <chrono>
#include <cstdint>
#include <iostream>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "map/chunk.hpp"
#include "tools/commands/signing_options.hpp"
#include "tools/commands/subcommands.hpp"
#include "tools/frames/frame_assembler.hpp"
#include "tools/map/block_file.hpp"
#include "tools/map/refusal_text.hpp"
#include "tools/program/add_option.hpp"
#include "tools/program/exit_status.hpp"
#include "tools/program/interrupt.hpp"
#include "tools/program/table.hpp"
#include "tools/receive/udp_receiver.hpp"
#include "tools/replay/map_sender.hpp"
#include "tools/replay/pace.hpp"
#include "tools/replay/udp_sender.hpp"
#include "tools/report/map_words.hpp"

namespace iog::tools {
namespace {

struct SendMapOptions {
  std::string file;
  std::string target = "127.0.0.1";
  std::uint16_t port = map::kMapPort;
  std::uint16_t listen = 0;
  std::string bind = "127.0.0.1";
  double rate = kChunksPerSecond;
  unsigned rounds = 5;
  SigningOptions signing;  // what it listens to is above
};

// What the target says of its map.
class Answer {
 public:
  Answer(const std::string& address, std::uint16_t port)
      : receiver_(address, port), assembler_([this](GridFrame&& frame) { take(frame); }) {}

  void listen(std::chrono::milliseconds wait) {
    for (const UdpReceiver::Message& message : receiver_.take(wait)) {
      assembler_.take(message.bytes);
    }
  }

  [[nodiscard]] const std::optional<stream::MapState>& latest() const { return latest_; }
  [[nodiscard]] bool has_frames() const { return has_frames_; }
  [[nodiscard]] bool uses(std::uint32_t crc) const {
    return latest_ && latest_->in_use && latest_->layer.crc == crc;
  }
  // Blocks refused since this listens.
  [[nodiscard]] bool has_refused() const {
    return latest_ && latest_->delivery.blocks_refused != refused_before_;
  }

 private:
  void take(const GridFrame& frame) {
    has_frames_ = true;
    if (!frame.classes || !frame.classes->has_end) {
      return;
    }
    if (!latest_) {
      refused_before_ = frame.classes->end.map.delivery.blocks_refused;
    }
    latest_ = frame.classes->end.map;
  }

  UdpReceiver receiver_;
  FrameAssembler assembler_;
  bool has_frames_ = false;
  std::optional<stream::MapState> latest_;
  std::uint32_t refused_before_ = 0;
};

class SendMap {
 public:
  explicit SendMap(const SendMapOptions& options)
      : options_(&options),
        block_(read_block(options.file)),
        signer_(signer_of(options)),
        sender_(options.target, {options.port}),
        map_(block_, sender_, 0, signer_) {
    if (options.listen != 0) {
      answer_.emplace(options.bind, options.listen);
    }
  }

  void run() {
    bool has_arrived = false;
    for (unsigned round = 0; round < options_->rounds && !has_arrived && !was_interrupted();
         ++round) {
      has_arrived = send_round();
      ++rounds_;
    }
    print();
    sender_.demand_sent();
    if (answer_ && !has_arrived) {
      throw CheckFailed(words_of_failure());
    }
  }

 private:
  static CommandSigner signer_of(const SendMapOptions& options) {
    SigningOptions signing = options.signing;
    signing.listen = options.listen;
    signing.bind = options.bind;
    return tools::signer_of(signing);
  }

  // As long as a block of 4 MiB is checked while frames are of silence, and half as much again.
  static constexpr std::chrono::seconds kPatience{5};

  // Whether the target uses the map.
  bool send_round() {
    Pace pace(1);
    for (std::size_t i = 0; i < map_.chunks() && !was_interrupted(); ++i) {
      pace.wait_for(static_cast<std::uint64_t>(static_cast<double>(i) * 1e6 / options_->rate));
      ++(map_.send(i) ? sent_ : refused_);
      if (answer_ && has_arrived(std::chrono::milliseconds(0))) {
        return true;
      }
    }
    return answer_ && wait_for_answer();
  }

  bool wait_for_answer() {
    const auto end = std::chrono::steady_clock::now() + kPatience;
    while (std::chrono::steady_clock::now() < end && !was_interrupted()) {
      if (has_arrived(std::chrono::milliseconds(50))) {
        return true;
      }
      if (answer_->has_refused() || is_incomplete()) {
        return false;
      }
    }
    return false;
  }

  [[nodiscard]] bool has_arrived(std::chrono::milliseconds wait) {
    answer_->listen(wait);
    return answer_->uses(map_.name().crc);
  }

  // Chunks are missing and none has come since the last look: the next round brings them.
  [[nodiscard]] bool is_incomplete() {
    const std::optional<stream::MapState>& state = answer_->latest();
    if (!state || state->delivery.state != map::DeliveryState::kReceiving) {
      return false;
    }
    const std::uint32_t there = state->delivery.chunks_there;
    const auto now = std::chrono::steady_clock::now();
    if (there != there_) {
      there_ = there;
      there_since_ = now;
    }
    return now - there_since_ > std::chrono::milliseconds(500);
  }

  [[nodiscard]] std::string words_of_failure() const {
    const std::optional<stream::MapState>& state = answer_->latest();
    if (!state) {
      const std::string port = " on port " + std::to_string(options_->listen);
      return answer_->has_frames() ? "the target sends grids" + port +
                                         " without classes, and takes no map: its car asks for "
                                         "grids = \"indexes\""
                                   : "no grid of a target came" + port + "; does it run?";
    }
    if (answer_->has_refused()) {
      return std::string("the target has refused the map: ") +
             refusal_text(state->delivery.last_refusal);
    }
    const std::string delivery = words_of_delivery(state->delivery);
    return "the target does not use the map after " + counted(rounds_, "round|rounds; ") +
           (delivery.empty() ? "no chunk of it came there" : delivery);
  }

  void print() const {
    std::cout << counted(sent_, "chunk|chunks of ") << options_->file << " sent in "
              << counted(rounds_, "round|rounds, ") << refused_ << " refused by the system\n";
    if (answer_ && answer_->latest()) {
      std::cout << map_table(*answer_->latest());
    } else if (!answer_) {
      std::cout << "whether they have arrived the target's stream says: --listen PORT\n";
    }
  }

  const SendMapOptions* options_;
  std::vector<std::uint8_t> block_;
  CommandSigner signer_;
  UdpSender sender_;
  MapSender map_;
  std::optional<Answer> answer_;
  std::uint64_t sent_ = 0;
  std::uint64_t refused_ = 0;
  unsigned rounds_ = 0;
  std::uint32_t there_ = 0;  // chunks, and since when no more
  std::chrono::steady_clock::time_point there_since_;
};

}  // namespace

void add_send_map(CLI::App& program) {
  auto* const command =
      program.add_subcommand("send-map", "Send a city map to a target until the target uses it");
  const auto options = std::make_shared<SendMapOptions>();
  add_option(*command, "FILE", "(required)", options->file, "Map of `iog map` (.iogmap)")
      ->required();
  add_option(*command, "--target", "ADDRESS  (default 127.0.0.1)", options->target,
             "IPv4 address to send to");
  add_option(*command, "--port", "PORT  (default 15011)", options->port, "UDP port of the target")
      ->check(CLI::Range(1, 65'535));
  add_option(*command, "--listen", "PORT", options->listen,
             "Receive the target's stream on this UDP port, and end when the target uses the map")
      ->check(CLI::Range(1, 65'535));
  add_option(*command, "--bind", "ADDRESS  (default 127.0.0.1)", options->bind,
             "IPv4 address to listen on")
      ->needs("--listen");
  add_signing_options(*command, options->signing);
  add_option(*command, "--rate", "N  (default 1000)", options->rate,
             "Chunks of 1280 bytes per second")
      ->check(CLI::Range(1.0, 100'000.0));
  add_option(*command, "--rounds", "N  (default 5)", options->rounds,
             "Maximum number of times that each chunk is sent")
      ->check(CLI::Range(1, 1'000));
  command->footer(
      "Exit status 1 if the target does not use the map at the end. Without --listen, all rounds "
      "are sent.\n"
      "Only one program can listen on a port; `iog view --forward PORT` forwards a stream.");
  command->callback([options] {
    catch_interrupts();
    SendMap(*options).run();
  });
}

}  // namespace iog::tools
