#include "tools/formats/lux/lux_stream.hpp"

#include "lidar/ibeo_lux.hpp"
#include "tools/program/exit_status.hpp"
#include "wire/byte_reader.hpp"

namespace iog::tools {
namespace {

using lidar::IbeoLux;

// The message at the beginning of the bytes, header and body; empty if there is none.
std::span<const std::byte> message_at(std::span<const std::byte> bytes) {
  wire::ByteReader header(bytes);
  const std::uint32_t magic = header.u32_be();
  header.skip(4);
  const std::size_t body_bytes = header.u32_be();
  header.skip(IbeoLux::kHeaderBytes - 12);
  if (!header.ok() || magic != IbeoLux::kMagic || body_bytes > header.remaining()) {
    return {};
  }
  return bytes.first(IbeoLux::kHeaderBytes + body_bytes);
}

bool is_scan(std::span<const std::byte> message) {
  return wire::load_be16(message.subspan<14, 2>()) == IbeoLux::kDataType;
}

}  // namespace

LuxStream read_lux_stream(std::span<const std::byte> bytes) {
  LuxStream stream;
  while (!bytes.empty()) {
    const auto message = message_at(bytes);
    if (message.empty()) {
      ++stream.skipped_bytes;
      bytes = bytes.subspan(1);
      continue;
    }
    bytes = bytes.subspan(message.size());
    if (!is_scan(message)) {
      ++stream.other_messages;
      continue;
    }
    try {
      stream.scans.push_back(parse_lux_message(message));
    } catch (const UsageError&) {
      ++stream.malformed;
    }
  }
  return stream;
}

}  // namespace iog::tools
