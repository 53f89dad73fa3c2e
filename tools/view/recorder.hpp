// Keeps what arrives, message by message and unchanged, as a capture that every tool opens.
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <string>

#include "tools/formats/capture/pcap_writer.hpp"

namespace iog::tools::view {

class Recorder {
 public:
  // Files go to that folder, which is made when the first one begins. port: the messages' UDP port.
  Recorder(std::string folder, std::uint16_t port) : folder_(std::move(folder)), port_(port) {}

  // Begins a file named after the time of day, `view_20260102_150405.pcap`, unless one is open.
  // UsageError if it cannot be written.
  void start();
  // Ends the recording in any case. UsageError if it has not been written completely.
  void stop();

  // Writes the message with its time of arrival, if a file is open. A message that is too long to
  // be ours is left out. UsageError if it cannot be written; the recording is over then.
  void take(std::span<const std::byte> message, std::uint64_t time_us);

  [[nodiscard]] bool is_open() const { return file_.has_value(); }
  [[nodiscard]] const std::string& path() const { return path_; }  // of the last file
  [[nodiscard]] std::uint64_t messages() const { return messages_; }
  [[nodiscard]] std::uint64_t bytes() const { return bytes_; }

 private:
  std::string folder_;
  std::uint16_t port_;
  std::optional<PcapWriter> file_;
  std::string path_;
  std::uint64_t messages_ = 0;
  std::uint64_t bytes_ = 0;
};

}  // namespace iog::tools::view
