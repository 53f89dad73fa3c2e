#include "tools/replay/port_queue.hpp"

#include <fstream>
#include <sstream>

namespace iog::tools {
namespace {

struct Queue {
  std::uint32_t address = 0;  // 0: of all addresses
  std::uint16_t port = 0;
  std::size_t bytes = 0;
};

// "1159: 0100007F:9585 00000000:0000 07 00000000:00000C40 ...": the third pair is what waits to be
// sent and to be read. An address is the number that the PC has in the bytes of the wire.
std::optional<Queue> queue_in(const std::string& line) {
  std::istringstream text(line);
  std::string number;
  std::string peer;
  std::string state;
  Queue queue;
  std::size_t to_send = 0;
  char colon = 0;
  text >> number >> std::hex >> queue.address >> colon >> queue.port >> peer >> state >> to_send >>
      colon >> queue.bytes;
  return text.fail() ? std::nullopt : std::optional(queue);
}

}  // namespace

std::optional<std::size_t> bytes_waiting(const std::vector<std::string>& lines,
                                         std::uint32_t address, std::uint16_t port) {
  std::optional<std::size_t> bytes;
  for (const std::string& line : lines) {
    const std::optional<Queue> queue = queue_in(line);
    if (queue && queue->port == port && (queue->address == address || queue->address == 0)) {
      bytes = bytes.value_or(0) + queue->bytes;
    }
  }
  return bytes;
}

std::optional<std::size_t> bytes_waiting(std::uint32_t address, std::uint16_t port) {
  std::ifstream file("/proc/net/udp");
  std::vector<std::string> lines;
  for (std::string line; std::getline(file, line);) {
    lines.push_back(line);
  }
  return bytes_waiting(lines, address, port);
}

}  // namespace iog::tools
