// iog worst: the frames that cost most, as the capture that the car's scanners would have sent.
#include <CLI/CLI.hpp>
#include <cstdint>
#include <iomanip>
#include <iostream>
#include <memory>
#include <sstream>
#include <string>

#include "tools/capture/pcap_writer.hpp"
#include "tools/command/exit_status.hpp"
#include "tools/command/subcommands.hpp"
#include "tools/worst/worst_frames.hpp"

namespace iog::tools {
namespace {

struct Options {
  bool only_names = false;
  std::string name;
  std::uint32_t frames = 4;
  std::uint64_t seed = 1;
  std::string out;
};

std::string list_of_frames() {
  std::ostringstream list;
  for (const WorstFrame& worst : all_worst_frames()) {
    list << "  " << std::left << std::setw(16) << worst.name << ' ' << worst.strain
         << (worst.is_forged ? " *" : "") << '\n';
  }
  return list.str();
}

void print_names() {
  for (const WorstFrame& worst : all_worst_frames()) {
    std::cout << worst.name << '\n';
  }
}

void write_worst(const Options& options) {
  const WorstFrame& worst = find_worst_frame(options.name);
  PcapWriter capture(options.out);
  std::uint64_t datagrams = 0;
  std::uint64_t bytes = 0;
  for (std::uint32_t frame = 0; frame < options.frames; ++frame) {
    for (const CapturedDatagram& datagram : worst_datagrams(worst, options.seed, frame)) {
      capture.write(datagram);
      ++datagrams;
      bytes += datagram.payload.size();
    }
  }
  capture.finish();
  std::cout << options.frames << " frames, " << datagrams << " packets, " << bytes
            << " bytes of scans in " << options.out << '\n';
}

}  // namespace

void add_worst(CLI::App& program) {
  constexpr std::uint32_t kMostFrames = 1000;
  auto* const command = program.add_subcommand(
      "worst", "Make up the frames that cost most and write what the car's scanners send");
  const auto options = std::make_shared<Options>();
  auto* const names = command->add_flag("--names", options->only_names,
                                        "Only print the names, one a line, for scripts");
  auto* const name = command->add_option("--name", options->name, "Which kind of frame, see below")
                         ->option_text("NAME");
  auto* const out = command->add_option("--out", options->out, "The capture to write (.pcap)")
                        ->option_text("FILE");
  name->needs(out)->excludes(names);
  out->needs(name);
  command->add_option("--frames", options->frames, "How many of them, 25 a second")
      ->option_text("N  (1 to 1000, default 4)")
      ->check(CLI::Range(1U, kMostFrames));
  command->add_option("--seed", options->seed, "Another seed, other random numbers")
      ->option_text("N  (default 1)")
      ->check(CLI::NonNegativeNumber);
  command->footer(
      "The kinds of frames, and what they are hard on (*: no LUX sends such a scan):\n" +
      list_of_frames() +
      "They are the reference car's. Every point of them is believed, and no scan is "
      "longer than\nthe car's description allows. The same name, seed and number give "
      "the same bytes everywhere.");
  command->callback([options] {
    if (options->only_names) {
      print_names();
    } else if (options->name.empty()) {
      throw UsageError("worst: --name and --out are required, or --names");
    } else {
      write_worst(*options);
    }
  });
}

}  // namespace iog::tools
