#include "tools/fuse/stream_recorder.hpp"

#include <stdexcept>

#include "protection/protected_message.hpp"
#include "stream/message.hpp"

namespace iog::tools {
namespace {

constexpr Endpoint kTarget{.ipv4 = 0x0A00020F, .port = 15001};
constexpr Endpoint kPeer{.ipv4 = 0x0A000202, .port = 15000};

}  // namespace

void StreamRecorder::take(std::span<const std::byte> message) {
  stream::Header header;
  std::span<const std::byte> body;
  if (stream::read_header(message.subspan(protection::kProtectionBytes), header, body) !=
      stream::ReadStatus::kOk) {
    throw std::logic_error("the pipeline has made a message without a header");
  }
  file_.write({.time_us = header.closed_us,
               .source = kTarget,
               .destination = kPeer,
               .payload = {message.begin(), message.end()}});
}

}  // namespace iog::tools
