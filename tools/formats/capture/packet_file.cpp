#include "tools/formats/capture/packet_file.hpp"

#include <algorithm>
#include <array>

#include "tools/formats/capture/file_hint.hpp"
#include "tools/formats/capture/link_layer.hpp"
#include "tools/program/exit_status.hpp"
#include "wire/byte_order.hpp"

namespace iog::tools {
namespace {

constexpr std::uint32_t kMicroseconds = 0xA1B2C3D4;
constexpr std::uint32_t kNanoseconds = 0xA1B23C4D;
constexpr std::uint32_t kSection = 0x0A0D0D0A;
constexpr std::uint32_t kByteOrder = 0x1A2B3C4D;

constexpr std::uint32_t kInterface = 1;
constexpr std::uint32_t kOldPacket = 2;
constexpr std::uint32_t kSimplePacket = 3;
constexpr std::uint32_t kPacket = 6;

// As in libpcap: a packet that claims more is damaged.
constexpr std::size_t kMostPacketBytes = 262'144;
constexpr std::size_t kMostBlockBytes = 16U << 20;

constexpr std::size_t kHintBytes = 1208;

std::string why_no_capture(const UnpackedFile& bytes) {
  if (!bytes.trouble().empty()) {
    return bytes.trouble();
  }
  const std::string hint = hint_of(bytes.begin());
  if (hint.empty()) {
    return "no capture: captures are pcap or pcapng files, as they are or packed by gzip or zstd";
  }
  const std::string packer = bytes.packer();
  return (packer.empty() ? "" : "packed by " + packer + ", which is unpacked for captures only: ") +
         hint;
}

std::size_t padded(std::size_t bytes) { return (bytes + 3) / 4 * 4; }

}  // namespace

PacketFile::PacketFile(const std::string& path) : bytes_(path) {
  std::array<std::byte, 24> header{};
  const std::span magic = std::span(header).first<4>();
  const bool has_magic = read(magic);
  is_pcapng_ = has_magic && wire::load_be32(magic) == kSection;
  for (const bool is_big : {false, true}) {
    const std::uint32_t number = is_big ? wire::load_be32(magic) : wire::load_le32(magic);
    if (has_magic && (number == kMicroseconds || number == kNanoseconds)) {
      is_big_endian_ = is_big;
      has_nanoseconds_ = number == kNanoseconds;
      if (read(std::span(header).subspan<4>())) {
        interfaces_.push_back({.link_type = static_cast<std::uint16_t>(word(header, 20))});
      }
    }
  }
  if (!is_pcapng_ && interfaces_.empty()) {
    std::array<std::byte, kHintBytes> more{};
    while (bytes_.begin().size() < more.size() && bytes_.read(more) > 0) {
    }
    throw UsageError(path + ": " + why_no_capture(bytes_));
  }
}

std::optional<std::uint16_t> PacketFile::link_type() const {
  return is_pcapng_ ? std::nullopt : std::optional(interfaces_.front().link_type);
}

std::optional<std::uint64_t> PacketFile::place() const {
  return is_pcapng_ || !bytes_.can_go() ? std::nullopt : std::optional(bytes_.place());
}

void PacketFile::go_to(std::uint64_t place) {
  if (!bytes_.go_to(place)) {
    throw UsageError("a capture cannot be read from another place");
  }
  trouble_.clear();
}

std::optional<CapturedPacket> PacketFile::next() {
  if (!trouble_.empty()) {
    return std::nullopt;
  }
  return is_pcapng_ ? next_of_pcapng() : next_of_pcap();
}

std::optional<CapturedPacket> PacketFile::next_of_pcap() {
  std::array<std::byte, 16> header{};
  if (!read(header, true)) {
    return std::nullopt;
  }
  const std::uint32_t kept = word(header, 8);
  const std::uint32_t magic = word(header, 0);
  if (magic == kMicroseconds || magic == kNanoseconds) {  // as a time: of 2055
    trouble_ =
        "cannot be read further: a second capture follows in the same file: split them into two "
        "files";
    return std::nullopt;
  }
  if (kept > kMostPacketBytes) {
    trouble_ = "cannot be read further: a packet of " + std::to_string(kept) + " bytes";
    return std::nullopt;
  }
  content_.resize(kept);
  if (!read(content_)) {
    return std::nullopt;
  }
  return CapturedPacket{.link_type = interfaces_.front().link_type,
                        .time_us = time_of(word(header, 0), word(header, 4)),
                        .is_cut = kept < word(header, 12),
                        .bytes = content_};
}

std::uint64_t PacketFile::time_of(std::uint32_t seconds, std::uint32_t fraction) {
  constexpr std::uint32_t kMicrosPerSecond = 1'000'000;
  first_s_ = packets_++ == 0 ? seconds : first_s_;
  last_s_ = seconds;
  has_long_fractions_ = has_long_fractions_ || fraction >= kMicrosPerSecond;
  return std::uint64_t{seconds} * kMicrosPerSecond +
         (has_nanoseconds_ || has_long_fractions_ ? fraction / 1000 : fraction);
}

std::string PacketFile::unit_words() const {
  constexpr std::uint64_t kEnough = 100;  // packets a second: not all within the first millisecond
  if (has_long_fractions_ && !has_nanoseconds_) {
    return "its header promises microseconds, and its times are nanoseconds, as which they are "
           "read";
  }
  const bool has_enough = last_s_ > first_s_ + 1 && packets_ > kEnough * (last_s_ - first_s_);
  return has_nanoseconds_ && !has_long_fractions_ && has_enough
             ? "its header promises nanoseconds, and all packets come in the first millisecond of "
               "a second: if its times are microseconds, its magic number has to be 0xA1B2C3D4"
             : "";
}

std::optional<CapturedPacket> PacketFile::next_of_pcapng() {
  std::uint32_t type = 0;
  while (const std::optional<Bytes> block = next_block(type)) {
    if (type == kSection) {
      interfaces_.clear();
    } else if (type == kInterface) {
      add_interface(*block);
    } else if (type == kPacket || type == kOldPacket || type == kSimplePacket) {
      const std::optional<CapturedPacket> packet = packet_in(type, *block);
      if (!packet) {
        trouble_ = "cannot be read further: a packet is longer than its block";
      }
      return packet;
    }
  }
  return std::nullopt;
}

// A section says its byte order behind its length, which is in that order already. The first one's
// type has been read.
std::optional<PacketFile::Bytes> PacketFile::next_block(std::uint32_t& type) {
  std::array<std::byte, 12> head{};
  const std::span begin(head);
  const bool is_first = bytes_.place() == 4;
  if (!is_first && !read(begin.first<4>(), true)) {
    return std::nullopt;
  }
  type = is_first ? kSection : word(head, 0);
  const bool is_section = type == kSection;
  const std::size_t head_bytes = is_section ? 12 : 8;
  if (!read(begin.subspan(4, head_bytes - 4))) {
    return std::nullopt;
  }
  is_big_endian_ = is_section ? wire::load_be32(begin.last<4>()) == kByteOrder : is_big_endian_;
  const std::size_t bytes = word(head, 4);
  const bool has_order = !is_section || word(head, 8) == kByteOrder;
  if (!has_order || bytes % 4 != 0 || bytes < head_bytes + 4 || bytes > kMostBlockBytes) {
    trouble_ = "cannot be read further: a block of " + std::to_string(bytes) + " bytes";
    return std::nullopt;
  }
  content_.resize(bytes - head_bytes);
  if (!read(content_)) {
    return std::nullopt;
  }
  return Bytes(content_).first(content_.size() - 4);  // behind it the length again
}

void PacketFile::add_interface(Bytes block) {
  constexpr std::uint16_t kUnit = 9;
  constexpr std::uint16_t kBegin = 14;
  constexpr std::size_t kHeadBytes = 8;
  Interface its{.link_type = kUnknownLink};
  if (block.size() >= kHeadBytes) {
    its.link_type = half(block, 0);
    its.most_bytes = word(block, 4);
  }
  for (std::size_t at = kHeadBytes; at + 4 <= block.size(); at += 4 + padded(half(block, at + 2))) {
    const std::size_t bytes = half(block, at + 2);
    const bool is_whole = at + 4 + bytes <= block.size();
    if (is_whole && half(block, at) == kUnit && bytes == 1) {
      its.unit = wire::load_u8(block.subspan(at + 4).first<1>());
    } else if (is_whole && half(block, at) == kBegin && bytes == 8) {
      const std::array<std::uint64_t, 2> parts{word(block, at + 4), word(block, at + 8)};
      its.begin_s = static_cast<std::int64_t>(is_big_endian_ ? parts[0] << 32 | parts[1]
                                                             : parts[1] << 32 | parts[0]);
    }
  }
  interfaces_.push_back(its);
}

// Nothing if the block is shorter than it says.
std::optional<CapturedPacket> PacketFile::packet_in(std::uint32_t type, Bytes block) {
  const std::size_t head_bytes = type == kSimplePacket ? 4 : 20;
  if (block.size() < head_bytes) {
    return std::nullopt;
  }
  const bool is_simple = type == kSimplePacket;
  const std::size_t number = is_simple ? 0 : type == kPacket ? word(block, 0) : half(block, 0);
  if (number >= interfaces_.size()) {
    return CapturedPacket{.link_type = kUnknownLink, .time_us = last_us_};
  }
  const Interface& its = interfaces_[number];
  const std::size_t whole = word(block, head_bytes - 4);
  // A simple packet says neither how much of it is kept nor when it came.
  const std::size_t most = its.most_bytes == 0 ? whole : its.most_bytes;
  const std::size_t kept = is_simple ? std::min(whole, most) : word(block, 12);
  if (kept > block.size() - head_bytes) {
    return std::nullopt;
  }
  last_us_ =
      is_simple ? last_us_ : time_of(its, std::uint64_t{word(block, 4)} << 32 | word(block, 8));
  return CapturedPacket{.link_type = its.link_type,
                        .time_us = last_us_,
                        .is_cut = kept < whole,
                        .bytes = block.subspan(head_bytes, kept)};
}

// 64 bits of units times 10^6 < 2^20 fit 128; a power of 10 beyond 10^19 would leave nothing.
std::uint64_t PacketFile::time_of(const Interface& its, std::uint64_t units) {
  __extension__ using Wide = unsigned __int128;
  constexpr unsigned kOfTwo = 0x80;
  const unsigned exponent = its.unit % kOfTwo;
  Wide micros = Wide{units} * 1'000'000U;
  if (its.unit >= kOfTwo) {
    micros >>= exponent;
  } else {
    for (unsigned i = 0; i < exponent && micros > 0; ++i) {
      micros /= 10;
    }
  }
  return static_cast<std::uint64_t>(micros) + static_cast<std::uint64_t>(its.begin_s) * 1'000'000U;
}

bool PacketFile::read(std::span<std::byte> to, bool may_end) {
  std::size_t made = 0;
  while (made < to.size()) {
    const std::size_t more = bytes_.read(to.subspan(made));
    if (more == 0) {
      trouble_ = bytes_.trouble();
      if (trouble_.empty() && (made > 0 || !may_end)) {
        trouble_ = "breaks off in a packet";
      }
      return false;
    }
    made += more;
  }
  return true;
}

std::uint16_t PacketFile::half(Bytes bytes, std::size_t at) const {
  const auto its = bytes.subspan(at).first<2>();
  return is_big_endian_ ? wire::load_be16(its) : wire::load_le16(its);
}

std::uint32_t PacketFile::word(Bytes bytes, std::size_t at) const {
  const auto its = bytes.subspan(at).first<4>();
  return is_big_endian_ ? wire::load_be32(its) : wire::load_le32(its);
}

}  // namespace iog::tools
