// iog receive: the grids of a target, put together, checked, counted and drawn.
#include <CLI/CLI.hpp>
#include <algorithm>
#include <chrono>
#include <cstdint>
#include <iostream>
#include <memory>
#include <optional>
#include <sstream>
#include <string>
#include <utility>
#include <vector>

#include "tools/commands/serial_options.hpp"
#include "tools/commands/signing_options.hpp"
#include "tools/commands/subcommands.hpp"
#include "tools/commands/vehicle_options.hpp"
#include "tools/formats/capture/made_capture.hpp"
#include "tools/formats/capture/pcap_writer.hpp"
#include "tools/formats/picture/frame_writer.hpp"
#include "tools/frames/chosen_frame.hpp"
#include "tools/frames/frame_assembler.hpp"
#include "tools/program/add_option.hpp"
#include "tools/program/exit_status.hpp"
#include "tools/program/fixed.hpp"
#include "tools/program/interrupt.hpp"
#include "tools/program/number_checks.hpp"
#include "tools/program/option_use.hpp"
#include "tools/program/progress.hpp"
#include "tools/receive/frame_notes.hpp"
#include "tools/receive/link_counts.hpp"
#include "tools/receive/run_statistics.hpp"
#include "tools/receive/serial/reception.hpp"
#include "tools/receive/udp_receiver.hpp"
#include "tools/vehicles/key_file.hpp"
#include "tools/vehicles/vehicle_catalogue.hpp"

namespace iog::tools {
namespace {

struct ReceiveOptions {
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
  std::string classes_hashes;
  std::string expect_classes;
  std::string stream;
  std::string key;
  SerialOptions serial;
};

using Clock = std::chrono::steady_clock;

class Reception {
 public:
  explicit Reception(const ReceiveOptions& options)
      : options_(&options),
        pictures_(options.pictures),
        notes_(options.notify),
        assembler_([this](GridFrame&& frame) { take(std::move(frame)); }),
        frames_wanted_(options.frames),
        progress_("frames", options.frames) {
    if (!options.stream.empty()) {
      stream_.emplace(options.stream);
    }
    if (!options.key.empty()) {
      assembler_.believe_signed(read_key_file(options.key));
    }
    if (!options.expect.empty()) {
      expected_ = read_records(options.expect);
      frames_wanted_ = frames_wanted_ > 0 ? frames_wanted_ : expected_.size();
    }
    if (!options.expect_classes.empty()) {
      expected_classes_ = read_class_records(options.expect_classes);
      frames_wanted_ = frames_wanted_ > 0 ? frames_wanted_ : expected_classes_.size();
    }
  }

  // Until enough frames have come, or none for too long, or somebody interrupts.
  void run() {
    UdpReceiver receiver(options_->bind, options_->port);
    notes_.say_listening();
    begin_ = last_evidence_ = last_message_ = Clock::now();
    while (!is_done() && !is_idle() && !receiver.has_ended()) {
      const UdpReceiver::Messages messages = receiver.take(std::chrono::milliseconds(100));
      const bool has_arrived = !messages.empty();
      if (has_arrived) {
        notes_.say_heard();
      }
      for (const UdpReceiver::Message& message : messages) {
        if (!is_done()) {  // what has begun of the frame behind the last is no loss
          if (stream_) {
            stream_->write(datagram_of_stream(message.time_us, message.bytes));
          }
          assembler_.take(message.bytes);
          if (stream_ && has_messages()) {
            stream_->keep_beginning();
          }
        }
      }
      datagrams_ += messages.size();
      note_arrival(has_arrived);
    }
    assembler_.finish();
    if (stream_ && has_messages()) {
      stream_->finish();
    }
    end_ = Clock::now();
    overflow_ = receiver.overflow();
  }

  void write_results() {
    if (chosen_.get()) {
      pictures_.write_last(*chosen_.get());
    } else if (has_messages()) {
      pictures_.write_none();
    }
    if (!options_->hashes.empty() && has_messages()) {
      write_records(options_->hashes, statistics_.records());
    }
    if (!options_->classes_hashes.empty() && has_messages()) {
      write_class_records(options_->classes_hashes, statistics_.classes().records());
    }
    if (!options_->summary.empty()) {
      Facts facts = statistics_.facts();
      facts.emplace_back("frames_missing", std::to_string(missing()));
      if (const CatalogueEntry* const car = vehicle_of_id(vehicle_id_.value_or(0))) {
        facts.emplace_back("frame_period_us", std::to_string(car->vehicle->frame_period_us));
      }
      for (const auto& [name, count] : all_counts()) {
        facts.emplace_back(name, std::to_string(count));
      }
      write_facts(options_->summary, facts);
    }
    print_table();
  }

  void check() {
    if (datagrams_ == 0) {
      throw CheckFailed(words_of_silence(options_->bind, options_->port, end_ - begin_,
                                         missing() > 0 ? "; " + words_of_missing() : ""));
    }
    if (assembler_.car_refusal()) {
      throw CheckFailed("the target has refused the car of its image and sends no grid: " +
                        *assembler_.car_refusal() + "; iog image puts another one there");
    }
    if (assembler_.counts().messages == 0 && assembler_.version_sent()) {
      throw CheckFailed("the target sends " + words_of_version(*assembler_.version_sent()));
    }
    if (assembler_.counts().messages == 0) {
      throw CheckFailed("no message of a grid came, and " + std::to_string(datagrams_) +
                        " other datagrams; who else sends to port " +
                        std::to_string(options_->port) + "?");
    }
    check_wholeness();
    if (options_->expect.empty() && options_->expect_classes.empty()) {
      if (!is_done() && frames_wanted_ > 0) {
        throw CheckFailed(words_before_silence() + words_of_missing());
      }
      return;
    }
    if (!options_->expect.empty()) {
      check_equal(statistics_.records(), expected_, "frames");
    }
    if (!options_->expect_classes.empty()) {
      check_equal(statistics_.classes().records(), expected_classes_, "frames' classes");
    }
  }

 private:
  // Whether a target was heard. What else comes must not replace older files.
  [[nodiscard]] bool has_messages() const {
    return assembler_.counts().is_any_of_target() || assembler_.car_refusal().has_value();
  }

  [[nodiscard]] bool is_done() const {
    return frames_wanted_ > 0 && statistics_.records().size() >= frames_wanted_;
  }

  // Frames with evidence that should have come, as far as anybody has said how many.
  [[nodiscard]] std::uint64_t missing() const {
    return frames_wanted_ - std::min<std::uint64_t>(frames_wanted_, statistics_.records().size());
  }

  [[nodiscard]] std::string words_of_missing() const {
    return std::to_string(missing()) + " of " + std::to_string(frames_wanted_) +
           " frames never came";
  }

  // A target that runs says every two frame periods that it has no evidence.
  [[nodiscard]] std::string words_before_silence() const {
    constexpr std::chrono::duration<double> kSilent{1.0};
    const std::chrono::duration<double> silent = end_ - last_message_;
    if (silent < kSilent) {
      return {};
    }
    return "the target sent nothing in the last " + fixed(silent.count(), 1) + " s: ";
  }

  void check_wholeness() const {
    const ClassStatistics& classes = statistics_.classes();
    const ObjectStatistics& objects = statistics_.objects();
    if (statistics_.damaged() + classes.damaged() > 0) {
      throw CheckFailed(std::to_string(statistics_.damaged()) + " frames, and the classes of " +
                        std::to_string(classes.damaged()) +
                        ", arrived whole and are not the grid that the target has hashed");
    }
    const std::uint64_t incomplete =
        statistics_.incomplete() + classes.incomplete() + objects.incomplete();
    if (options_->strict && (assembler_.messages_lost() + incomplete > 0 || overflow_ > 0)) {
      throw CheckFailed(words_before_silence() +
                        "messages were lost: " + std::to_string(assembler_.messages_lost()) +
                        " by their numbers; incomplete are " +
                        std::to_string(statistics_.incomplete()) + " frames, the classes of " +
                        std::to_string(classes.incomplete()) + " and the objects of " +
                        std::to_string(objects.incomplete()) +
                        (missing() > 0 ? "; " + words_of_missing() : ""));
    }
  }

  // With --frames the first ones are compared.
  template <typename Record>
  void check_equal(const std::vector<Record>& received, std::vector<Record> expected,
                   const std::string& what) const {
    if (received.empty() && expected.empty()) {
      return;  // of a car without classes
    }
    if (options_->frames > 0 && options_->frames < expected.size()) {
      expected.resize(options_->frames);
    }
    if (const auto difference = first_difference(received, expected)) {
      throw CheckFailed(words_before_silence() + *difference);
    }
    table() << row("expected",
                   "all " + std::to_string(expected.size()) + " " + what + " are equal");
  }

  [[nodiscard]] bool is_idle() const {
    const std::chrono::duration<double> silent = Clock::now() - last_evidence_;
    return options_->idle_timeout_s > 0 && silent.count() > options_->idle_timeout_s;
  }

  void note_arrival(bool has_arrived) {
    const auto now = Clock::now();
    if (has_arrived) {
      last_arrival_ = last_message_ = now;
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
    notes_.say_frames(statistics_);
    vehicle_id_ = frame.header.vehicle_id;
    if (!frame.header.has_evidence()) {
      return;
    }
    last_evidence_ = Clock::now();
    progress_.show(frame.evidence_number + 1);
    pictures_.offer(frame);
    chosen_.offer(std::move(frame));
  }

  [[nodiscard]] LinkCounts all_counts() const {
    LinkCounts counts = link_counts(assembler_);
    counts.emplace_back("messages_overflow", overflow_);
    return counts;
  }

  // With --notify standard output belongs to whoever reads the notes, such as `iog replay --step`.
  [[nodiscard]] std::ostream& table() const { return options_->notify ? std::cerr : std::cout; }

  void print_table() const {
    if (vehicle_id_) {
      table() << row("vehicle", words_of_vehicle(*vehicle_id_));
    }
    table() << statistics_.table(true) << rows_of(all_counts());
    if (missing() > 0) {
      table() << row("frames missing", words_of_missing());
    }
  }

  const ReceiveOptions* options_;
  RunStatistics statistics_;
  std::optional<std::uint32_t> vehicle_id_;  // of the last frame
  FrameWriter pictures_;
  FrameNotes notes_;
  std::optional<PcapWriter> stream_;
  FrameAssembler assembler_;
  std::vector<FrameRecord> expected_;
  std::vector<ClassRecord> expected_classes_;
  std::uint64_t frames_wanted_;
  Progress progress_;
  ChosenFrame chosen_;
  Clock::time_point begin_;
  Clock::time_point end_;
  Clock::time_point last_evidence_;
  Clock::time_point last_arrival_ = Clock::now();  // or when a silence was noted
  Clock::time_point last_message_;
  std::uint64_t datagrams_ = 0;
  std::uint64_t overflow_ = 0;
};

void receive(ReceiveOptions& options) {
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
      program.add_subcommand("receive", "Receive the grids of a target, check them and draw them");
  const auto options = std::make_shared<ReceiveOptions>();
  add_option(*command, "--port", "PORT  (this or --serial)", options->port,
             "UDP port to receive on")
      ->check(CLI::Range(1, 65'535));
  add_option(*command, "--bind", "ADDRESS  (default 127.0.0.1)", options->bind,
             "IPv4 address to receive on");
  add_serial_options(*command, options->serial);
  add_believing_option(*command, options->key);
  add_vehicle_file_option(*command);
  add_picture_options(*command, options->pictures);
  add_option(*command, "--frames", "N  (default the number in --expect)", options->frames,
             "End after this number of frames with evidence")
      ->check(not_below_zero());
  add_option(*command, "--idle-timeout", "SECONDS", options->idle_timeout_s,
             "End after this time without a frame with evidence")
      ->check(above_zero());
  command->add_flag("--notify", options->notify,
                    "Print `listening`, `heard` at the first message, then `frame N` or `nothing "
                    "taken` per frame");
  add_option(*command, "--hashes", "FILE", options->hashes,
             "Write one line per frame, as `iog fuse --hashes` does");
  add_option(*command, "--expect", "FILE", options->expect,
             "Compare the frames with a file of --hashes; exit status 1 if they differ");
  add_option(
      *command, "--classes-hashes", "FILE", options->classes_hashes,
      "Write one line per frame of the perception grid, as `iog fuse --classes-hashes` does");
  add_option(*command, "--expect-classes", "FILE", options->expect_classes,
             "Compare the frames with a file of --classes-hashes; exit status 1 if they differ");
  add_option(*command, "--stream", "FILE", options->stream,
             "Write the received messages as a capture (.pcap)");
  command->add_flag("--strict", options->strict, "Exit status 1 also if a message was lost");
  add_option(*command, "--summary", "FILE", options->summary,
             "Write the numbers of the table as key=value lines");
  command->footer(
      "Ctrl-C also ends the reception. The table is still printed, with --notify on standard "
      "error.\n"
      "Reports of silence are frames without evidence. They are counted, but have no number.\n"
      "--serial shows the newest cells of each tile over the coarse grids (docs/spec.md 3.8) and "
      "counts frames by their numbers.\n" +
      std::string(kPictureFooter));
  command->callback([command, options] {
    demand_use(*command, options->serial.path.empty(),
               {"--bind", "--key", "--notify", "--hashes", "--expect", "--classes-hashes",
                "--expect-classes", "--stream", "--strict"},
               "--port");
    demand_use(*command, !options->pictures.folder.empty(), {"--every", "--scale", "--radius"},
               "--out FOLDER");
    catch_interrupts();
    receive(*options);
  });
}

}  // namespace iog::tools
