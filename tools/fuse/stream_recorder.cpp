#include "tools/fuse/stream_recorder.hpp"

#include <stdexcept>

#include "protection/protected_message.hpp"
#include "stream/message.hpp"
#include "tools/formats/capture/made_capture.hpp"

namespace iog::tools {

void StreamRecorder::take(std::span<const std::byte> message) {
  stream::Header header;
  std::span<const std::byte> body;
  if (stream::read_header(message.subspan(protection::kProtectionBytes), header, body) !=
      stream::ReadStatus::kOk) {
    throw std::logic_error("the pipeline has made a message without a header");
  }
  file_.write(datagram_of_stream(header.closed_us, message));
}

}  // namespace iog::tools
