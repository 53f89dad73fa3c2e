#include "tools/relay/scan_stream.hpp"

#include <algorithm>
#include <array>
#include <optional>

#include "tools/program/exit_status.hpp"
#include "wire/byte_reader.hpp"

namespace iog::tools {
namespace {

using lidar::IbeoLux;

constexpr std::array kMagic{std::byte{0xAF}, std::byte{0xFE}, std::byte{0xC0}, std::byte{0xC2}};

bool is_scan(std::span<const std::byte> head) {
  return wire::load_be16(head.subspan<14, 2>()) == IbeoLux::kDataType;
}

constexpr std::size_t kNotYetKnown = SIZE_MAX;

// As far as there are bytes.
bool begins_with_magic(std::span<const std::byte> bytes) {
  const std::size_t known = std::min(bytes.size(), kMagic.size());
  return std::ranges::equal(bytes.first(known), std::span(kMagic).first(known));
}

// A magic word among other bytes would have a length as wild as theirs, and hold up what follows: a
// scan says twice how long it is.
std::size_t scan_bytes(std::span<const std::byte> bytes, std::size_t body) {
  constexpr std::size_t kCountOffset = IbeoLux::kHeaderBytes + 28;
  if (body < IbeoLux::kScanBytes || body > ScanStream::kMostScanBytes - IbeoLux::kHeaderBytes) {
    return 0;
  }
  if (bytes.size() < kCountOffset + 2) {
    return kNotYetKnown;
  }
  const std::size_t points = wire::load_le16(bytes.subspan<kCountOffset, 2>());
  if (body != IbeoLux::kScanBytes + IbeoLux::kPointBytes * points) {
    return 0;
  }
  const std::size_t size = IbeoLux::kHeaderBytes + body;
  return size <= bytes.size() ? size : kNotYetKnown;
}

// Of another message nothing is known but that the next one follows it.
std::size_t other_bytes(std::span<const std::byte> bytes, std::size_t body) {
  const std::size_t size = IbeoLux::kHeaderBytes + body;
  if (size > ScanStream::kMostOtherBytes) {
    return 0;
  }
  if (size + kMagic.size() > bytes.size()) {
    return size <= bytes.size() && !begins_with_magic(bytes.subspan(size)) ? 0 : kNotYetKnown;
  }
  return begins_with_magic(bytes.subspan(size)) ? size : 0;
}

// How long the message is that begins here; 0: none does.
std::size_t message_bytes(std::span<const std::byte> bytes) {
  if (!begins_with_magic(bytes)) {
    return 0;
  }
  if (bytes.size() < IbeoLux::kHeaderBytes) {
    return kNotYetKnown;
  }
  const std::size_t body = wire::load_be32(bytes.subspan<8, 4>());
  return is_scan(bytes) ? scan_bytes(bytes, body) : other_bytes(bytes, body);
}

}  // namespace

void ScanStream::tell(std::span<const std::byte> message, const OnScan& on_scan) {
  if (!is_scan(message)) {
    ++counts_.other_messages;
    return;
  }
  std::optional<LuxScan> scan;
  try {
    scan = parse_lux_message(message);
  } catch (const UsageError&) {
    ++counts_.malformed;
    return;
  }
  ++counts_.scans;
  on_scan(std::move(*scan));
}

void ScanStream::take(std::span<const std::byte> bytes, const OnScan& on_scan) {
  held_.insert(held_.end(), bytes.begin(), bytes.end());
  std::span<const std::byte> rest = held_;
  while (!rest.empty()) {
    const std::size_t size = message_bytes(rest);
    if (size == kNotYetKnown) {
      break;
    }
    if (size == 0) {
      ++counts_.skipped_bytes;
      rest = rest.subspan(1);
      continue;
    }
    tell(rest.first(size), on_scan);
    rest = rest.subspan(size);
  }
  held_.erase(held_.begin(), held_.end() - static_cast<std::ptrdiff_t>(rest.size()));
}

void ScanStream::end() {
  counts_.skipped_bytes += held_.size();
  held_.clear();
}

}  // namespace iog::tools
