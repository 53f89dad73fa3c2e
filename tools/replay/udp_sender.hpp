// Sends datagrams to a host, a port for each sensor, for the poses and for maps.
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <vector>

namespace iog::tools {

class UdpSender {
 public:
  // host: a dotted IPv4 address. UsageError if it is none, or without a socket.
  UdpSender(const std::string& host, std::vector<std::uint16_t> ports);
  ~UdpSender();
  UdpSender(const UdpSender&) = delete;
  UdpSender& operator=(const UdpSender&) = delete;

  // To the port of that number, below ports.size(). False if the system did not take it.
  bool send(std::size_t index, std::span<const std::byte> payload);

  // CheckFailed if the system has refused all datagrams, such as without a network.
  void demand_sent() const;

  // Whether a program on this PC has read all that was sent to the port of that number. Empty of
  // another host, or where the system does not say.
  [[nodiscard]] std::optional<bool> has_been_taken(std::size_t index) const;

 private:
  std::string host_;
  int socket_;
  std::uint32_t address_;  // in the byte order of the wire
  std::vector<std::uint16_t> ports_;
  bool has_sent_ = false;
  int refusal_ = 0;  // errno of the last one
};

}  // namespace iog::tools
