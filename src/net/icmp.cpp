#include "net/icmp.hpp"

#include "net/checksum.hpp"
#include "wire/byte_order.hpp"
#include "wire/byte_reader.hpp"
#include "wire/byte_writer.hpp"

namespace iog::net {
namespace {

constexpr std::uint8_t kTypeEchoReply = 0;
constexpr std::uint8_t kTypeEchoRequest = 8;
constexpr std::uint8_t kCodeEcho = 0;
constexpr std::size_t kChecksumOffset = 2;

}  // namespace

IcmpStatus classify_icmp(std::span<const std::byte> message) {
  if (message.size() < kIcmpHeaderBytes || internet_checksum(message) != 0) {
    return IcmpStatus::kBad;
  }
  wire::ByteReader reader{message};
  const std::uint8_t type = reader.u8();
  const std::uint8_t code = reader.u8();
  const bool echo = type == kTypeEchoRequest && code == kCodeEcho;
  return echo ? IcmpStatus::kEchoRequest : IcmpStatus::kOther;
}

void write_echo_reply(std::span<std::byte> target, std::span<const std::byte> request) {
  wire::ByteReader reader{request};
  reader.skip(4);  // type, code and checksum are written anew
  wire::ByteWriter writer{target};
  writer.u8(kTypeEchoReply);
  writer.u8(kCodeEcho);
  writer.u16_be(0);
  writer.bytes(reader.bytes(reader.remaining()));
  if (writer.ok()) {
    const std::uint16_t checksum = internet_checksum(writer.written());
    wire::store_be16(target.subspan<kChecksumOffset, 2>(), checksum);
  }
}

}  // namespace iog::net
