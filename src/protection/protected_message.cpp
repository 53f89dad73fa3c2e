#include "protection/protected_message.hpp"

namespace iog::protection {

void Sender::protect(std::span<std::byte> message, TailRemainder tail) {
  write_some_ip_header(event_, session_id_, message);
  session_id_ = session_after(session_id_);
  protector_.protect(message.subspan(kSomeIpLengthOffset), tail);
}

Received Receiver::receive(std::span<const std::byte> datagram) {
  Received received{.header = check_some_ip_header(event_, datagram)};
  if (received.header == SomeIpStatus::kWrongVersion) {
    received.interface_version = interface_version_of(datagram);
  }
  if (received.header != SomeIpStatus::kOk) {
    return received;
  }
  received.check = checker_.check(datagram.subspan(kSomeIpLengthOffset));
  if (received.check != CheckStatus::kError) {
    received.delta_counter = checker_.delta_counter();
    received.content = datagram.subspan(kProtectionBytes);
  }
  return received;
}

}  // namespace iog::protection
