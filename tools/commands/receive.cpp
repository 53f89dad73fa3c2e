// iog receive: the grids of a target, put together, checked, counted and drawn.
#include <CLI/CLI.hpp>
#include <chrono>
#include <cstdint>
#include <iostream>
#include <memory>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "tools/commands/subcommands.hpp"
#include "tools/formats/picture/frame_writer.hpp"
#include "tools/program/exit_status.hpp"
#include "tools/program/interrupt.hpp"
#include "tools/program/progress.hpp"
#include "tools/receive/frame_assembler.hpp"
#include "tools/receive/link_counts.hpp"
#include "tools/receive/nothing_came.hpp"
#include "tools/receive/run_statistics.hpp"
#include "tools/receive/serial/reception.hpp"
#include "tools/receive/udp_receiver.hpp"

namespace iog::tools {
namespace {

struct Options {
  std::uint16_t port = 0;
  std::string bind = "127.0.0.1";
  PictureOptions pictures;
  std::uint64_t frames = 0;
  double idle_timeout_s = 0;
  bool notify = false;
  bool strict = false;
  std::string hashes;
  std::string summary;
  std::string expect;
  SerialOptions serial;
};

using Clock = std::chrono::steady_clock;

class Reception {
 public:
  explicit Reception(const Options& options)
      : options_(&options),
        pictures_(options.pictures),
        assembler_([this](GridFrame&& frame) { take(std::move(frame)); }),
        frames_wanted_(options.frames),
        progress_("frames", options.frames) {
    if (!options.expect.empty()) {
      expected_ = read_records(options.expect);
      frames_wanted_ = frames_wanted_ > 0 ? frames_wanted_ : expected_.size();
    }
  }

  // Until enough frames have come, or none for too long, or somebody interrupts.
  void run() {
    UdpReceiver receiver(options_->bind, options_->port);
    if (options_->notify) {
      std::cout << "listening" << std::endl;
    }
    begin_ = last_evidence_ = Clock::now();
    while (!is_done() && !was_interrupted() && !is_idle()) {
      const UdpReceiver::Messages messages = receiver.take(std::chrono::milliseconds(100));
      for (const std::vector<std::byte>& message : messages) {
        assembler_.take(message);
      }
      datagrams_ += messages.size();
      note_arrival(!messages.empty());
    }
    assembler_.finish();
    end_ = Clock::now();
    overflow_ = receiver.overflow();
  }

  void write_results() {
    if (last_) {
      pictures_.write_last(*last_);
    }
    if (!options_->hashes.empty()) {
      write_records(options_->hashes, statistics_.records());
    }
    if (!options_->summary.empty()) {
      RunStatistics::Facts facts = statistics_.facts();
      for (const auto& [name, count] : all_counts()) {
        facts.emplace_back(name, std::to_string(count));
      }
      write_facts(options_->summary, facts);
    }
    print_table();
  }

  void check() {
    if (datagrams_ == 0) {
      throw CheckFailed(words_of_silence(options_->bind, options_->port, end_ - begin_));
    }
    if (assembler_.counts().messages == 0) {
      throw CheckFailed("no message of a grid came, and " + std::to_string(datagrams_) +
                        " other datagrams; who else sends to port " +
                        std::to_string(options_->port) + "?");
    }
    if (statistics_.damaged() > 0) {
      throw CheckFailed(std::to_string(statistics_.damaged()) +
                        " frames arrived whole and are not the grid that the target has hashed");
    }
    const std::uint64_t lost = assembler_.messages_lost() + statistics_.incomplete();
    if (options_->strict && (lost > 0 || overflow_ > 0)) {
      throw CheckFailed("messages were lost: " + std::to_string(assembler_.messages_lost()) +
                        " missing, " + std::to_string(statistics_.incomplete()) +
                        " frames incomplete");
    }
    if (options_->expect.empty()) {
      if (!is_done() && frames_wanted_ > 0) {
        throw CheckFailed("only " + std::to_string(statistics_.records().size()) + " of " +
                          std::to_string(frames_wanted_) + " frames came");
      }
      return;
    }
    if (options_->frames > 0 && options_->frames < expected_.size()) {
      expected_.resize(options_->frames);
    }
    if (const auto difference = first_difference(statistics_.records(), expected_)) {
      throw CheckFailed(*difference);
    }
    table() << row("expected", "all " + std::to_string(expected_.size()) + " frames are equal");
  }

 private:
  [[nodiscard]] bool is_done() const {
    return frames_wanted_ > 0 && statistics_.records().size() >= frames_wanted_;
  }

  [[nodiscard]] bool is_idle() const {
    const std::chrono::duration<double> silent = Clock::now() - last_evidence_;
    return options_->idle_timeout_s > 0 && silent.count() > options_->idle_timeout_s;
  }

  void note_arrival(bool has_arrived) {
    const auto now = Clock::now();
    if (has_arrived) {
      last_arrival_ = now;
    } else if (now - last_arrival_ > FrameAssembler::kLongestSilence) {
      assembler_.note_silence();
      last_arrival_ = now;
    }
  }

  void take(GridFrame&& frame) {
    if (is_done()) {
      return;
    }
    statistics_.add(frame);
    if (!frame.header.has_evidence()) {
      return;
    }
    if (options_->notify) {
      std::cout << "frame " << frame.evidence_number << std::endl;
    }
    last_evidence_ = Clock::now();
    progress_.show(frame.evidence_number + 1);
    pictures_.offer(frame);
    last_ = std::move(frame);
  }

  [[nodiscard]] LinkCounts all_counts() const {
    LinkCounts counts = link_counts(assembler_);
    counts.emplace_back("messages_overflow", overflow_);
    return counts;
  }

  // With --notify standard output belongs to whoever reads the notes, such as `iog replay --step`.
  [[nodiscard]] std::ostream& table() const { return options_->notify ? std::cerr : std::cout; }

  void print_table() const { table() << statistics_.table(true) << rows_of(all_counts()); }

  const Options* options_;
  RunStatistics statistics_;
  FrameWriter pictures_;
  FrameAssembler assembler_;
  std::vector<FrameRecord> expected_;
  std::uint64_t frames_wanted_;
  Progress progress_;
  std::optional<GridFrame> last_;
  Clock::time_point begin_;
  Clock::time_point end_;
  Clock::time_point last_evidence_;
  Clock::time_point last_arrival_ = Clock::now();
  std::uint64_t datagrams_ = 0;
  std::uint64_t overflow_ = 0;
};

void add_serial_options(CLI::App& command, SerialOptions& options) {
  command
      .add_option("--serial", options.path,
                  "Instead of UDP: a terminal device, a Unix socket such as QEMU's, or a file")
      ->option_text("PATH")
      ->excludes("--port");
  command.add_option("--baud", options.baud, "With --serial: the rate of a terminal device")
      ->option_text("RATE  (default 115200)")
      ->needs("--serial");
  command
      .add_option("--max-age", options.max_age_s,
                  "With --serial: show cells that are older as the coarse grids have them")
      ->option_text("SECONDS  (default 5)")
      ->check(CLI::PositiveNumber)
      ->needs("--serial");
  command
      .add_option("--tiles", options.tiles,
                  "With --serial: write frame, number and cells' CRC of each tile that was told of")
      ->option_text("FILE")
      ->needs("--serial");
}

void receive(Options& options) {
  if (!options.serial.path.empty()) {
    options.serial.pictures = options.pictures;
    options.serial.frames = options.frames;
    options.serial.idle_timeout_s = options.idle_timeout_s;
    options.serial.summary = options.summary;
    receive_serial(options.serial);
    return;
  }
  if (options.port == 0) {
    throw UsageError("give --port PORT to receive over UDP, or --serial PATH");
  }
  Reception reception(options);
  reception.run();
  reception.write_results();
  reception.check();
}

}  // namespace

void add_receive(CLI::App& program) {
  auto* const command =
      program.add_subcommand("receive", "Receive the grids of a target, check and draw them");
  const auto options = std::make_shared<Options>();
  command->add_option("--port", options->port, "UDP port to receive on")
      ->option_text("PORT  (this or --serial)")
      ->check(CLI::Range(1, 65'535));
  command->add_option("--bind", options->bind, "IPv4 address to receive on")
      ->option_text("ADDRESS  (default 127.0.0.1)");
  add_serial_options(*command, options->serial);
  add_picture_options(*command, options->pictures);
  command
      ->add_option("--frames", options->frames,
                   "End after so many frames with evidence; else those of --expect")
      ->option_text("N")
      ->check(CLI::NonNegativeNumber);
  command
      ->add_option("--idle-timeout", options->idle_timeout_s,
                   "End after so many seconds without such a frame")
      ->option_text("SECONDS")
      ->check(CLI::PositiveNumber);
  command->add_flag("--notify", options->notify,
                    "Say `listening`, then `frame N` for each frame, on standard output");
  command
      ->add_option("--hashes", options->hashes,
                   "Write one line per frame, as `iog fuse --hashes` does")
      ->option_text("FILE");
  command
      ->add_option("--expect", options->expect,
                   "Compare with such a file; exit status 1 if they differ")
      ->option_text("FILE");
  command->add_flag("--strict", options->strict, "Exit status 1 also if a message was lost");
  command
      ->add_option("--summary", options->summary,
                   "Write the numbers of the table as key=value lines")
      ->option_text("FILE");
  command->footer(
      "Ctrl-C ends it, too; the table is printed all the same, with --notify on standard error.\n"
      "Reports of silence are frames without evidence: they are counted, not numbered.\n"
      "--serial shows of each tile the newest cells, beneath them the coarse grids (docs/spec.md "
      "3.8);\n"
      "frames are then counted by their numbers.\n" +
      std::string(kPictureFooter));
  command->callback([options] {
    catch_interrupts();
    receive(*options);
  });
}

}  // namespace iog::tools
