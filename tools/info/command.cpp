// iog info: what is in a capture.
#include <CLI/CLI.hpp>
#include <iostream>
#include <memory>
#include <optional>
#include <string>

#include "tools/capture/pcap_reader.hpp"
#include "tools/command/progress.hpp"
#include "tools/command/subcommands.hpp"
#include "tools/info/capture_census.hpp"

namespace iog::tools {
namespace {

void show(const std::string& path) {
  PcapReader capture(path);
  CaptureCensus census;
  Progress progress("packets");
  while (const std::optional<CapturedDatagram> datagram = capture.next()) {
    census.add(*datagram);
    progress.show(capture.counts().datagrams);
  }
  std::cout << census.table();
  if (const std::string skipped = describe_skipped(capture.counts()); !skipped.empty()) {
    std::cout << skipped << '\n';
  }
  if (capture.is_cut_off()) {
    std::cout << "the file breaks off in a packet\n";
  }
}

}  // namespace

void add_info(CLI::App& program) {
  auto* const command =
      program.add_subcommand("info", "Say what is in a capture: ports, formats, scans, rates");
  const auto path = std::make_shared<std::string>();
  command->add_option("--pcap", *path, "The capture to read (pcap or pcapng)")
      ->option_text("FILE  (required)")
      ->required();
  command->callback([path] { show(*path); });
}

}  // namespace iog::tools
