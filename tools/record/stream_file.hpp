// The datagrams of a recorded stream, out of a capture or an MCAP file of `iog record`.
#pragma once

#include <fstream>
#include <memory>
#include <optional>
#include <string>

#include "tools/formats/capture/datagram.hpp"
#include "tools/formats/capture/pcap_reader.hpp"
#include "tools/formats/mcap/reader.hpp"

namespace iog::tools {

class StreamFile {
 public:
  // UsageError if the file is neither.
  explicit StreamFile(const std::string& path);

  // The next datagram of the stream; nothing at the end. Other datagrams of a capture are skipped.
  [[nodiscard]] std::optional<CapturedDatagram> next();

  // Not behind the next datagram, for go_to(); nothing in a file that is read from its beginning
  // only.
  using Place = PcapReader::Place;
  [[nodiscard]] std::optional<Place> place() const;

  // Goes on from a place() of this file, or a little before it.
  void go_to(const Place& place);

  // How much of the file has been read, 0 to 1; nothing where nobody knows its size.
  [[nodiscard]] std::optional<double> part_read() const;

  // Says on stderr, when all has been read, whether the file breaks off or is damaged, what was
  // skipped, and what its clock did.
  void warn(const std::string& path) const;

 private:
  [[nodiscard]] std::optional<CapturedDatagram> next_of_mcap();

  std::unique_ptr<PcapReader> capture_;
  std::ifstream file_;
  std::unique_ptr<mcap::Reader> mcap_;
  SteadyTime mcap_clock_;
};

// Whether the file begins as an MCAP file does.
[[nodiscard]] bool is_mcap_file(const std::string& path);

}  // namespace iog::tools
