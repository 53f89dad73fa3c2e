// Sends datagrams to a host, one port for each sensor.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <string>

namespace iog::tools {

class UdpSender {
 public:
  // host: a dotted IPv4 address. UsageError if it is none, or without a socket.
  UdpSender(const std::string& host, std::uint16_t port_base);
  ~UdpSender();
  UdpSender(const UdpSender&) = delete;
  UdpSender& operator=(const UdpSender&) = delete;

  // To port_base + index. False if the system did not take it.
  bool send(std::size_t index, std::span<const std::byte> payload);

 private:
  int socket_;
  std::uint32_t address_;  // in the byte order of the wire
  std::uint16_t port_base_;
};

}  // namespace iog::tools
