// An image that exercises the Ethernet port alone: it returns every frame it gets, and answers a
// frame of type 0x88b5 (IEEE 802 local experiment 1) by as many numbered frames as the frame asks
// for. A frame of type 0x88b6 (experiment 2) stops the controller behind the port's back.
#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <type_traits>
#include <utility>

#include "board.hpp"
#include "stopped_controller.hpp"
#include "text_line.hpp"

namespace {

using iog::board::Board;
using Port = std::remove_reference_t<decltype(std::declval<Board&>().ethernet())>;

constexpr std::size_t kTypeAt = 12;
constexpr std::size_t kCountAt = 14;
constexpr std::size_t kBurstFrameBytes = 1514;

std::uint16_t big_endian_16(std::span<const std::byte> bytes, std::size_t at) {
  return static_cast<std::uint16_t>(std::to_integer<unsigned>(bytes[at]) << 8 |
                                    std::to_integer<unsigned>(bytes[at + 1]));
}

// Queues `count` frames; those the ring refuses are counted by the port.
void answer_burst(Port& port, std::span<const std::byte> asked, std::uint16_t count) {
  for (std::uint16_t number = 0; number < count; ++number) {
    const std::span<std::byte> frame = port.acquire();
    if (frame.empty()) {
      return;
    }
    std::copy_n(asked.begin(), kCountAt, frame.begin());
    frame[kCountAt] = static_cast<std::byte>(number >> 8);
    frame[kCountAt + 1] = static_cast<std::byte>(number & 0xff);
    port.commit(kBurstFrameBytes);
  }
}

void echo(Port& port, std::span<const std::byte> received) {
  const std::span<std::byte> frame = port.acquire();
  if (!frame.empty()) {
    std::copy(received.begin(), received.end(), frame.begin());
    port.commit(received.size());
  }
}

void serve(Port& port, std::span<const std::byte> received) {
  const std::uint16_t type = received.size() >= 16 ? big_endian_16(received, kTypeAt) : 0;
  if (type == 0x88b5) {
    answer_burst(port, received, big_endian_16(received, kCountAt));
    return;
  }
  if (type == 0x88b6) {
    iog::tests::stop_controller();
  }
  echo(port, received);
}

void report(Board& board) {
  const iog::hal::PortCounters counters = board.ethernet().counters();
  iog::board::TextLine line;
  line.text("received ").decimal(counters.received);
  line.text(" errors ").decimal(counters.receive_errors);
  line.text(" oversized ").decimal(counters.oversized);
  line.text(" sent ").decimal(counters.sent);
  line.text(" refused ").decimal(counters.send_refused);
  line.text(" restarts ").decimal(counters.restarts);
  line.text(" unsent ").decimal(counters.lost_unsent).text("\n");
  board.console().write(line.view());
}

}  // namespace

int main() {
  Board board({0x02, 0, 0, 0, 0, 1});
  Port& port = board.ethernet();
  bool link_was_up = false;
  std::uint32_t reported = 0;
  for (;;) {
    board.watchdog().service();
    for (auto frame = port.receive(); !frame.empty(); frame = port.receive()) {
      serve(port, frame);
      port.release();
    }
    port.pump();
    if (port.link().up != link_was_up) {
      link_was_up = port.link().up;
      board.console().write(link_was_up ? "link up\n" : "link down\n");
    }
    const auto seconds = static_cast<std::uint32_t>(board.clock().now_us() / 1'000'000);
    if (seconds != reported) {
      reported = seconds;
      report(board);
    }
    board.idle();
  }
}
