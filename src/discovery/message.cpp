#include "discovery/message.hpp"

#include <algorithm>

#include "net/ipv4.hpp"
#include "wire/byte_reader.hpp"
#include "wire/byte_writer.hpp"

namespace iog::discovery {
namespace {

constexpr std::size_t kSessionOffset = 10;
constexpr std::uint8_t kIpv4Endpoint = 0x04;
constexpr std::uint16_t kEndpointLength = 9;  // bytes after the type

struct Option {
  std::uint8_t type = 0;
  std::span<const std::byte> content{};  // after the type
};

// Reads the next option. Its length counts the reserved byte, so it must not be 0.
std::optional<Option> next_option(wire::ByteReader& in) {
  const std::size_t length = in.u16_be();
  const std::uint8_t type = in.u8();
  const auto content = in.bytes(length);
  return in.ok() && length != 0 ? std::optional(Option{type, content}) : std::nullopt;
}

bool are_whole(std::span<const std::byte> options) {
  wire::ByteReader in(options);
  while (in.remaining() > 0) {
    if (!next_option(in)) {
      return false;
    }
  }
  return true;
}

std::optional<Endpoint> udp_endpoint_of(const Option& option) {
  if (option.type != kIpv4Endpoint || option.content.size() != kEndpointLength) {
    return std::nullopt;
  }
  wire::ByteReader in(option.content);
  in.skip(1);
  Endpoint endpoint{.address = {in.u32_be()}};
  in.skip(1);
  const std::uint8_t protocol = in.u8();
  endpoint.port = in.u16_be();
  return protocol == net::kProtocolUdp ? std::optional(endpoint) : std::nullopt;
}

bool refers_to(const Entry& entry, std::size_t option) {
  return std::ranges::any_of(entry.options, [option](const OptionRun& run) {
    return option >= run.first && option - run.first < run.count;
  });
}

// One past the highest option number that the entry refers to.
std::size_t options_needed(const Entry& entry) {
  std::size_t needed = 0;
  for (const OptionRun& run : entry.options) {
    needed = std::max(needed, run.count == 0 ? 0 : std::size_t{run.first} + run.count);
  }
  return needed;
}

void write_entry(const Entry& entry, wire::ByteWriter& out) {
  out.u8(static_cast<std::uint8_t>(entry.type));
  out.u8(entry.options[0].first);
  out.u8(entry.options[1].first);
  out.u8(static_cast<std::uint8_t>(entry.options[0].count << 4 | entry.options[1].count));
  out.u16_be(entry.service);
  out.u16_be(entry.instance);
  out.u32_be(std::uint32_t{entry.major} << 24 | entry.ttl_s);
  out.u32_be(entry.minor);
}

void write_endpoint(const Endpoint& endpoint, wire::ByteWriter& out) {
  out.u16_be(kEndpointLength);
  out.u8(kIpv4Endpoint);
  out.zeros(1);
  out.u32_be(endpoint.address.value);
  out.zeros(1);
  out.u8(net::kProtocolUdp);
  out.u16_be(endpoint.port);
}

}  // namespace

Entry Message::entry(std::size_t number) const {
  wire::ByteReader in(entries.subspan(number * kEntryBytes, kEntryBytes));
  Entry entry;
  entry.type = static_cast<EntryType>(in.u8());
  entry.options[0].first = in.u8();
  entry.options[1].first = in.u8();
  const std::uint8_t counts = in.u8();
  entry.options[0].count = counts >> 4;
  entry.options[1].count = counts & 0xFU;
  entry.service = in.u16_be();
  entry.instance = in.u16_be();
  const std::uint32_t major_and_ttl = in.u32_be();
  entry.major = static_cast<std::uint8_t>(major_and_ttl >> 24);
  entry.ttl_s = major_and_ttl & kForeverS;
  entry.minor = in.u32_be();
  return entry;
}

std::optional<Endpoint> Message::udp_endpoint_of(const Entry& entry) const {
  wire::ByteReader in(options);
  std::optional<Endpoint> found;
  std::size_t number = 0;
  for (; in.remaining() > 0; ++number) {
    const auto option = next_option(in);
    const auto endpoint = option ? discovery::udp_endpoint_of(*option) : std::nullopt;
    if (!endpoint || !refers_to(entry, number)) {
      continue;
    }
    if (found && *found != *endpoint) {
      return std::nullopt;
    }
    found = endpoint;
  }
  return number >= options_needed(entry) ? found : std::nullopt;
}

std::optional<Message> read_message(std::span<const std::byte> datagram) {
  if (protection::check_some_ip_header(kDiscoveryEvent, datagram) !=
      protection::SomeIpStatus::kOk) {
    return std::nullopt;
  }
  wire::ByteReader in(datagram);
  in.skip(kSessionOffset);
  Message message{.session_id = in.u16_be()};
  in.skip(protection::kSomeIpHeaderBytes - kSessionOffset - 2);
  message.flags = in.u8();
  in.skip(3);
  message.entries = in.bytes(in.u32_be());
  message.options = in.bytes(in.u32_be());
  const bool is_sound = in.ok() && in.remaining() == 0 && message.session_id != 0 &&
                        message.entries.size() % kEntryBytes == 0 && are_whole(message.options);
  return is_sound ? std::optional(message) : std::nullopt;
}

std::size_t write_message(std::uint16_t session_id, std::uint8_t flags,
                          std::span<const Entry> entries, const Endpoint& endpoint,
                          std::span<std::byte> buffer) {
  wire::ByteWriter out(buffer);
  out.skip(protection::kSomeIpHeaderBytes);
  out.u8(flags);
  out.zeros(3);
  out.u32_be(static_cast<std::uint32_t>(entries.size() * kEntryBytes));
  for (const Entry& entry : entries) {
    write_entry(entry, out);
  }
  const bool has_option =
      std::ranges::any_of(entries, [](const Entry& entry) { return options_needed(entry) != 0; });
  out.u32_be(has_option ? kEndpointBytes : 0);
  if (has_option) {
    write_endpoint(endpoint, out);
  }
  const std::size_t bytes = out.written().size();
  protection::write_some_ip_header(kDiscoveryEvent, session_id, buffer.first(bytes));
  return bytes;
}

}  // namespace iog::discovery
