// The scans in the bytes of an ibeo unit's TCP connection, which come in pieces cut anywhere.
#pragma once

#include <cstddef>
#include <cstdint>
#include <functional>
#include <span>
#include <vector>

#include "lidar/ibeo_lux.hpp"
#include "tools/formats/lux/lux_scan.hpp"

namespace iog::tools {

class ScanStream {
 public:
  // A scan counts its points with 16 bits. Other messages are lists of objects at most.
  static constexpr std::size_t kMostScanBytes = lidar::IbeoLux::kHeaderBytes +
                                                lidar::IbeoLux::kScanBytes +
                                                lidar::IbeoLux::kPointBytes * 0xFFFF;
  static constexpr std::size_t kMostOtherBytes = 65'536;

  struct Counts {
    std::uint64_t scans = 0;
    std::uint64_t other_messages = 0;  // of another data type, as soon as the next one begins
    std::uint64_t malformed = 0;       // scans that contradict themselves
    std::uint64_t skipped_bytes = 0;   // in search of the next message

    friend bool operator==(const Counts&, const Counts&) = default;
  };

  using OnScan = std::function<void(LuxScan)>;

  // Total. Each scan is told as soon as its last byte is there, and what cannot be the begin of a
  // message is skipped byte by byte. Never holds more than a message and these bytes.
  void take(std::span<const std::byte> bytes, const OnScan& on_scan);

  // The connection is over: what is held will have no end. The next one begins anew.
  void end();

  [[nodiscard]] const Counts& counts() const { return counts_; }
  [[nodiscard]] std::size_t held_bytes() const { return held_.size(); }

 private:
  void tell(std::span<const std::byte> message, const OnScan& on_scan);

  std::vector<std::byte> held_;
  Counts counts_;
};

}  // namespace iog::tools
