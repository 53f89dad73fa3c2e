// worst_frames: the frames that cost most, as the capture that the car's scanners would have sent.
#include <CLI/CLI.hpp>
#include <cstdint>
#include <iomanip>
#include <iostream>
#include <memory>
#include <sstream>
#include <string>
#include <utility>
#include <vector>

#include "lab/scenarios/worst_frames.hpp"
#include "tools/formats/capture/pcap_writer.hpp"
#include "tools/program/program.hpp"

namespace iog::lab {
namespace {

struct Options {
  bool only_names = false;
  std::string name;
  std::uint32_t frames = kMeasuredWorstFrames;
  std::uint64_t seed = 1;
  std::string out;
  bool has_poses = false;
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
  tools::PcapWriter capture(options.out);
  std::uint64_t datagrams = 0;
  std::uint64_t bytes = 0;
  tools::PoseFeed poses = poses_of_worst_frames(options.frames);
  for (std::uint32_t frame = 0; frame < options.frames; ++frame) {
    std::vector<tools::CapturedDatagram> sent = worst_datagrams(worst, options.seed, frame);
    if (options.has_poses) {
      sent = tools::with_poses(std::move(sent), poses);
    }
    for (const tools::CapturedDatagram& datagram : sent) {
      capture.write(datagram);
      ++datagrams;
      bytes += datagram.payload.size();
    }
  }
  capture.finish();
  std::cout << options.frames << " frames, " << datagrams << " packets, " << bytes << " bytes in "
            << options.out << '\n';
}

void add_options(CLI::App& program) {
  constexpr std::uint32_t kMostFrames = 1000;
  const auto options = std::make_shared<Options>();
  auto* const names = program.add_flag("--names", options->only_names,
                                       "Only print the names, one a line, for scripts");
  auto* const name = program.add_option("--name", options->name, "Which kind of frame, see below")
                         ->option_text("NAME");
  auto* const out = program.add_option("--out", options->out, "The capture to write (.pcap)")
                        ->option_text("FILE");
  name->needs(out)->excludes(names);
  out->needs(name);
  program.add_option("--frames", options->frames, "How many of them, 25 a second")
      ->option_text("N  (1 to 1000, default 4)")
      ->check(CLI::Range(1U, kMostFrames));
  program.add_option("--seed", options->seed, "Another seed, other random numbers")
      ->option_text("N  (default 1)")
      ->check(CLI::NonNegativeNumber);
  program.add_flag("--poses", options->has_poses,
                   "And the poses of a car that goes straight ahead at 15 m/s, for classes");
  program.footer("The kinds of frames, and what they are hard on (*: no LUX sends such a scan):\n" +
                 list_of_frames() +
                 "They are the reference car's. Every point of them is believed, and no scan is "
                 "longer than\nthe car's description allows. The same name, seed and number give "
                 "the same bytes everywhere.");
  program.callback([options] {
    if (options->only_names) {
      print_names();
    } else if (options->name.empty()) {
      throw tools::UsageError("--name and --out are required, or --names");
    } else {
      write_worst(*options);
    }
  });
}

}  // namespace
}  // namespace iog::lab

int main(int argc, char** argv) {
  CLI::App program("Make up the frames that cost most and write what the car's scanners send",
                   "worst_frames");
  iog::lab::add_options(program);
  return iog::tools::run_program(program, argc, argv);
}
