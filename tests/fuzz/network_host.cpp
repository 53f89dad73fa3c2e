// A network host on a series of Ethernet frames. The flag in front of a frame asks for right
// checksums and our addresses to be put in, which the fuzzer would not find by itself.
#include <algorithm>

#include "law.hpp"
#include "net/checksum.hpp"
#include "net/station.hpp"
#include "wire/byte_order.hpp"

namespace iog::fuzz {
namespace {

using net::testing::Frame;

constexpr std::size_t kIpOffset = 14;
constexpr std::size_t kMaxFrameBytes = 1514;

// Sets the field of two bytes so that the sum over the bytes is right.
void put_checksum(std::span<std::byte> bytes, std::size_t at) {
  if (bytes.size() >= at + 2) {
    wire::store_be16(bytes.subspan(at).first<2>(), 0);
    wire::store_be16(bytes.subspan(at).first<2>(), net::internet_checksum(bytes));
  }
}

void repair(Frame& frame) {
  if (frame.size() < kIpOffset + 20) {
    return;
  }
  std::ranges::copy(std::as_bytes(std::span(net::testing::kConfig.mac.octets)), frame.begin());
  wire::store_be16(std::span(frame).subspan<12, 2>(), 0x0800);
  const auto ip = std::span(frame).subspan(kIpOffset);
  ip[0] = std::byte{0x45};
  wire::store_be16(ip.subspan<2, 2>(), static_cast<std::uint16_t>(ip.size()));
  wire::store_be16(ip.subspan<6, 2>(), 0);
  put_checksum(ip.first(20), 10);
  const auto body = ip.subspan(20);
  if (ip[9] == std::byte{1}) {
    put_checksum(body, 2);
  } else if (body.size() >= 8) {
    wire::store_be16(body.subspan<4, 2>(), static_cast<std::uint16_t>(body.size()));
    wire::store_be16(body.subspan<6, 2>(), 0);  // no checksum
  }
}

}  // namespace

void check(std::span<const std::byte> input) {
  wire::ByteReader in(input);
  net::testing::Station station;
  std::uint64_t now_us = 0;
  while (in.remaining() > 0) {
    const std::uint8_t flags = in.u8();
    const auto piece = next_piece(in);
    Frame frame(piece.begin(), piece.begin() + static_cast<std::ptrdiff_t>(
                                                   std::min(piece.size(), kMaxFrameBytes)));
    if (frame.empty()) {
      continue;
    }
    if ((flags & 1U) != 0) {
      repair(frame);
    }
    now_us += std::uint64_t{flags} * 1000;
    const auto datagram = station.take(frame, now_us);
    if (datagram) {
      law(datagram->payload.size() + 42 <= frame.size(), "a payload lies in its frame");
    }
    law(!station.poll(now_us) && station.conserved(), "each frame has one fate");
    station.port.pump();
  }
}

}  // namespace iog::fuzz
