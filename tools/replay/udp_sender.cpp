#include "tools/replay/udp_sender.hpp"

#include <arpa/inet.h>
#include <cerrno>
#include <cstring>
#include <sys/socket.h>
#include <unistd.h>
#include <utility>

#include "tools/program/exit_status.hpp"
#include "tools/replay/port_queue.hpp"

namespace iog::tools {

UdpSender::UdpSender(const std::string& host, std::vector<std::uint16_t> ports)
    : host_(host), socket_(-1), address_(0), ports_(std::move(ports)) {
  in_addr address{};
  if (inet_pton(AF_INET, host.c_str(), &address) != 1) {
    throw UsageError("--target " + host + ": give an IPv4 address such as 127.0.0.1");
  }
  address_ = address.s_addr;
  socket_ = socket(AF_INET, SOCK_DGRAM | SOCK_CLOEXEC, 0);
  if (socket_ < 0) {
    throw UsageError("no UDP socket to be had from this system");
  }
}

UdpSender::~UdpSender() { close(socket_); }

bool UdpSender::send(std::size_t index, std::span<const std::byte> payload) {
  sockaddr_in to{};
  to.sin_family = AF_INET;
  to.sin_addr.s_addr = address_;
  to.sin_port = htons(ports_.at(index));
  const auto sent = sendto(socket_, payload.data(), payload.size(), 0,
                           reinterpret_cast<const sockaddr*>(&to), sizeof to);
  const bool is_sent = sent == static_cast<ssize_t>(payload.size());
  has_sent_ = has_sent_ || is_sent;
  refusal_ = is_sent ? refusal_ : errno;
  return is_sent;
}

void UdpSender::demand_sent() const {
  if (refusal_ != 0 && !has_sent_) {
    throw CheckFailed("nothing could be sent to " + host_ + ": " + std::strerror(refusal_) +
                      ". Is the network of this PC up, and is this the target's address?");
  }
}

std::optional<bool> UdpSender::has_been_taken(std::size_t index) const {
  constexpr std::uint32_t kLoopback = 127;  // 127.0.0.0/8 (RFC 1122, 3.2.1.3)
  if (ntohl(address_) >> 24U != kLoopback) {
    return std::nullopt;
  }
  const std::optional<std::size_t> waiting = bytes_waiting(address_, ports_.at(index));
  return waiting ? std::optional(*waiting == 0) : std::nullopt;
}

}  // namespace iog::tools
