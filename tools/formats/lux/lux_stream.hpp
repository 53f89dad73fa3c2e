// A file of ibeo messages, back to back, as a scanner sends them over TCP and as recorders store
// them.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "tools/formats/lux/lux_scan.hpp"

namespace iog::tools {

struct LuxStream {
  std::vector<LuxScan> scans;
  std::uint64_t other_messages = 0;  // of another data type
  std::uint64_t malformed = 0;       // scans that contradict themselves
  std::uint64_t skipped_bytes = 0;   // in search of the next message
};

// Total: whatever the bytes are, every message that can be found in them is.
[[nodiscard]] LuxStream read_lux_stream(std::span<const std::byte> bytes);

}  // namespace iog::tools
