#include "net/ipv4.hpp"

#include "net/checksum.hpp"
#include "wire/byte_reader.hpp"
#include "wire/byte_writer.hpp"

namespace iog::net {
namespace {

constexpr std::uint8_t kVersion = 4;
constexpr std::size_t kHeaderWordBytes = 4;
constexpr std::uint8_t kTimeToLive = 64;
constexpr std::uint16_t kDontFragment = 0x4000;
constexpr std::uint16_t kMoreFragments = 0x2000;
constexpr std::uint16_t kFragmentOffsetMask = 0x1FFF;
constexpr std::uint32_t kFragmentUnitBytes = 8;

}  // namespace

Ipv4Result parse_ipv4(std::span<const std::byte> bytes) {
  wire::ByteReader reader{bytes};
  const std::uint8_t version_and_words = reader.u8();
  reader.skip(1);  // type of service
  const std::size_t total_bytes = reader.u16_be();
  const std::uint16_t identification = reader.u16_be();
  const std::uint16_t fragment = reader.u16_be();
  reader.skip(1);  // time to live: a host accepts any value (RFC 1122, section 3.2.1.7)
  const std::uint8_t protocol = reader.u8();
  reader.skip(2);  // checksum, verified below together with the rest of the header
  const Ipv4Address source{reader.u32_be()};
  const Ipv4Address destination{reader.u32_be()};

  const std::size_t header_bytes = (version_and_words & 0x0FU) * kHeaderWordBytes;
  if (!reader.ok() || version_and_words >> 4 != kVersion || header_bytes < kIpv4HeaderBytes ||
      total_bytes < header_bytes || total_bytes > bytes.size()) {
    return {.status = Ipv4Status::kBadHeader};
  }
  if (internet_checksum(bytes.first(header_bytes)) != 0) {
    return {.status = Ipv4Status::kBadChecksum};
  }
  const bool is_whole = (fragment & (kMoreFragments | kFragmentOffsetMask)) == 0;
  return {.status = is_whole ? Ipv4Status::kOk : Ipv4Status::kFragment,
          .packet = {.source = source,
                     .destination = destination,
                     .protocol = protocol,
                     .identification = identification,
                     .fragment_offset = (fragment & kFragmentOffsetMask) * kFragmentUnitBytes,
                     .has_more_fragments = (fragment & kMoreFragments) != 0,
                     .payload = bytes.first(total_bytes).subspan(header_bytes)}};
}

// Sums the words while writing them, because the target may be uncached.
void write_ipv4_header(std::span<std::byte, kIpv4HeaderBytes> target, const Ipv4Header& header) {
  constexpr std::uint16_t kVersionLengthAndService =
      (kVersion << 4 | kIpv4HeaderBytes / kHeaderWordBytes) << 8;  // type of service: routine
  const auto total_bytes = static_cast<std::uint16_t>(kIpv4HeaderBytes + header.payload_bytes);
  const bool is_fragment = header.has_more_fragments || header.fragment_offset != 0;
  const auto fragment =
      static_cast<std::uint16_t>(header.fragment_offset / kFragmentUnitBytes |
                                 (header.has_more_fragments ? kMoreFragments : std::uint16_t{0}) |
                                 (is_fragment ? std::uint16_t{0} : kDontFragment));
  const auto life_and_protocol = static_cast<std::uint16_t>(kTimeToLive << 8 | header.protocol);
  Checksum sum;
  wire::ByteWriter writer{target};
  for (const std::uint16_t word : {kVersionLengthAndService, total_bytes, header.identification,
                                   fragment, life_and_protocol}) {
    sum.add_u16(word);
    writer.u16_be(word);
  }
  sum.add_u32(header.source.value);
  sum.add_u32(header.destination.value);
  writer.u16_be(sum.value());
  writer.u32_be(header.source.value);
  writer.u32_be(header.destination.value);
}

}  // namespace iog::net
