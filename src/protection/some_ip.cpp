#include "protection/some_ip.hpp"

#include "wire/byte_reader.hpp"
#include "wire/byte_writer.hpp"

namespace iog::protection {
namespace {

constexpr std::uint16_t kClientId = 0;  // a notification answers no request
constexpr std::uint8_t kProtocolVersion = 1;
constexpr std::uint8_t kNotification = 0x02;
constexpr std::uint8_t kReturnOk = 0x00;
constexpr std::size_t kInterfaceVersionOffset = 13;

}  // namespace

void write_some_ip_header(const Event& event, std::uint16_t session_id,
                          std::span<std::byte> message) {
  wire::ByteWriter out(message.first(kSomeIpHeaderBytes));
  out.u16_be(event.service_id);
  out.u16_be(event.event_id);
  out.u32_be(static_cast<std::uint32_t>(message.size() - kSomeIpLengthOffset));
  out.u16_be(kClientId);
  out.u16_be(session_id);
  out.u8(kProtocolVersion);
  out.u8(event.interface_version);
  out.u8(kNotification);
  out.u8(kReturnOk);
}

SomeIpStatus check_some_ip_header(const Event& event, std::span<const std::byte> datagram) {
  wire::ByteReader in(datagram);
  const std::uint16_t service_id = in.u16_be();
  const std::uint16_t event_id = in.u16_be();
  const std::uint32_t length = in.u32_be();
  in.skip(4);
  const std::uint8_t protocol_version = in.u8();
  const std::uint8_t interface_version = in.u8();
  const std::uint8_t type = in.u8();
  const std::uint8_t return_code = in.u8();
  if (!in.ok() || length > datagram.size() - kSomeIpLengthOffset) {
    return SomeIpStatus::kTooShort;
  }
  if (protocol_version != kProtocolVersion || service_id != event.service_id ||
      event_id != event.event_id) {
    return SomeIpStatus::kNotOurs;
  }
  if (length < datagram.size() - kSomeIpLengthOffset) {
    return SomeIpStatus::kTooLong;
  }
  if (interface_version != event.interface_version) {
    return SomeIpStatus::kWrongVersion;
  }
  return type == kNotification && return_code == kReturnOk ? SomeIpStatus::kOk
                                                           : SomeIpStatus::kWrongType;
}

std::uint8_t interface_version_of(std::span<const std::byte> datagram) {
  wire::ByteReader in(datagram);
  in.skip(kInterfaceVersionOffset);
  return in.u8();
}

}  // namespace iog::protection
