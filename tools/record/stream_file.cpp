#include "tools/record/stream_file.hpp"

#include <algorithm>
#include <array>

#include "tools/formats/capture/made_capture.hpp"
#include "tools/program/exit_status.hpp"
#include "tools/receive/stream_census.hpp"
#include "tools/record/mcap_recording.hpp"

namespace iog::tools {

bool is_mcap_file(const std::string& path) {
  std::array<char, mcap::kMagic.size()> magic{};
  std::ifstream(path, std::ios::binary).read(magic.data(), magic.size());
  return std::ranges::equal(std::as_bytes(std::span(magic)),
                            std::as_bytes(std::span(mcap::kMagic)));
}

StreamFile::StreamFile(const std::string& path) {
  if (!is_mcap_file(path)) {
    capture_ = std::make_unique<PcapReader>(path);
    return;
  }
  file_.open(path, std::ios::binary);
  mcap_ = std::make_unique<mcap::Reader>(file_);
}

std::optional<CapturedDatagram> StreamFile::next() {
  if (mcap_) {
    return next_of_mcap();
  }
  while (std::optional<CapturedDatagram> datagram = capture_->next()) {
    if (StreamCensus::is_message(datagram->payload)) {
      return datagram;
    }
  }
  return std::nullopt;
}

std::optional<CapturedDatagram> StreamFile::next_of_mcap() {
  while (const std::optional<mcap::Message> message = mcap_->next()) {
    if (mcap_->channels().at(message->channel_id).topic != kMessagesTopic) {
      continue;
    }
    if (const auto bytes = ros::bytes_of_uint8_multi_array(message->data)) {
      return datagram_of_stream(message->log_ns / 1000, *bytes);
    }
  }
  return std::nullopt;
}

std::optional<std::uint64_t> StreamFile::place() const {
  return capture_ ? capture_->place() : mcap_->place();
}

void StreamFile::go_to(std::uint64_t place) {
  if (capture_) {
    capture_->go_to(place);
  } else {
    mcap_->go_to(place);
  }
}

std::optional<double> StreamFile::part_read() const {
  return capture_ ? capture_->part_read() : mcap_->part_read();
}

bool StreamFile::is_damaged() const {
  if (capture_) {
    return !capture_->trouble().empty() || capture_->counts().skipped() > 0;
  }
  const mcap::ReadCounts& counts = mcap_->counts();
  return !mcap_->is_finished() ||
         counts.broken_chunks + counts.unreadable_chunks + counts.malformed > 0;
}

}  // namespace iog::tools
