// Captures of one drive as one: their datagrams by time, of equal times those of the file that is
// named first. Of each file no more than the next datagram is kept.
#pragma once

#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "tools/formats/capture/pcap_reader.hpp"

namespace iog::tools {

class CaptureSet {
 public:
  struct File {
    std::string path;
    std::unique_ptr<PcapReader> reader;
    std::optional<CapturedDatagram> next{};  // of several files
  };

  // UsageError as of PcapReader.
  explicit CaptureSet(const std::vector<std::string>& paths);

  [[nodiscard]] std::optional<CapturedDatagram> next();
  [[nodiscard]] const std::vector<File>& files() const { return files_; }

  // A message that names a file that begins after a pause and may thus belong to another drive.
  // Empty if there is none so far.
  [[nodiscard]] const std::string& words() const { return words_; }

  // As of PcapReader; no place in several files.
  [[nodiscard]] std::optional<PcapReader::Place> place() const;
  void go_to(const PcapReader::Place& place) { files_.front().reader->go_to(place); }
  [[nodiscard]] std::uint64_t datagrams() const;
  // Of the first file; the others are about as far.
  [[nodiscard]] std::optional<double> part_read() const {
    return files_.front().reader->part_read();
  }

 private:
  void note_gap(const File& file);

  std::vector<File> files_;
  std::uint64_t last_us_ = 0;  // of several files
  std::string words_;
};

}  // namespace iog::tools
