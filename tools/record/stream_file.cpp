#include "tools/record/stream_file.hpp"

#include <algorithm>
#include <array>
#include <iostream>

#include "tools/formats/capture/made_capture.hpp"
#include "tools/formats/ros/grid_messages.hpp"
#include "tools/receive/stream_census.hpp"

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
      return datagram_of_stream(mcap_clock_.of(message->log_ns / 1000), *bytes);
    }
  }
  return std::nullopt;
}

std::optional<StreamFile::Place> StreamFile::place() const {
  if (capture_) {
    return capture_->place();
  }
  const std::optional<std::uint64_t> at = mcap_->place();
  return at ? std::optional(Place{.at = *at, .clock = mcap_clock_}) : std::nullopt;
}

void StreamFile::go_to(const Place& place) {
  if (capture_) {
    capture_->go_to(place);
  } else {
    mcap_->go_to(place.at);
    mcap_clock_ = place.clock;
  }
}

std::optional<double> StreamFile::part_read() const {
  return capture_ ? capture_->part_read() : mcap_->part_read();
}

void StreamFile::warn(const std::string& path) const {
  if (capture_) {
    warn_of(path, *capture_);
    return;
  }
  const mcap::ReadCounts& counts = mcap_->counts();
  if (!mcap_->is_finished() ||
      counts.broken_chunks + counts.unreadable_chunks + counts.malformed > 0) {
    std::cerr << "iog: " << path << ": breaks off or is damaged; used as far as it goes\n";
  }
  if (const std::string words = mcap_clock_.words(); !words.empty()) {
    std::cerr << "iog: " << path << ": " << words << '\n';
  }
}

}  // namespace iog::tools
