// The receiver of the serial link on a series of messages, and on any bytes. A CRC keeps random
// bytes out; so the input's messages are protected and framed by a sender of ours, unless they say
// that they come as they are.
#include <algorithm>
#include <vector>

#include "framing/cobs.hpp"
#include "law.hpp"
#include "stream/channel.hpp"
#include "tools/receive/serial/serial_link.hpp"

namespace iog::fuzz {
namespace {

using Bytes = std::vector<std::byte>;

constexpr std::size_t kMaxMessages = 32;

Bytes frame_of(std::span<const std::byte> content, protection::Sender& sender) {
  const std::size_t bytes = std::min(content.size(), protection::kMaxContentBytes);
  Bytes message(protection::kProtectionBytes);
  message.insert(message.end(), content.begin(),
                 content.begin() + static_cast<std::ptrdiff_t>(bytes));
  sender.protect(message);
  Bytes frame(framing::max_framed_bytes(message.size()));
  frame.resize(framing::encode_cobs(message, frame));
  return frame;
}

void check(const tools::SerialLink& link) {
  const tools::LayeredGrid& grid = link.grid();
  if (link.counts().messages == 0) {
    law(!grid.newest(), "nothing comes from nothing");
    return;
  }
  for (std::size_t tile = 0; tile < geometry::kTileCount; ++tile) {
    const auto told = grid.cells_of(tile);
    law(!told || !told->cells || std::ranges::count(*told->cells, std::byte{0x80}) == 0,
        "a cell is an index");
  }
}

void receive(wire::ByteReader in) {
  tools::SerialLink link;
  protection::Sender sender(stream::kSerialChannel);
  for (std::size_t messages = 0; in.remaining() > 0 && messages < kMaxMessages; ++messages) {
    const std::span<const std::byte> piece = next_piece(in);
    if (!piece.empty() && piece.front() == std::byte{0xFF}) {
      link.take(piece.subspan(1));
    } else {
      link.take(frame_of(piece, sender));
    }
  }
  check(link);
}

}  // namespace

void check(std::span<const std::byte> input) {
  tools::SerialLink raw;
  raw.take(input);
  check(raw);
  receive(wire::ByteReader(input));
}

}  // namespace iog::fuzz
