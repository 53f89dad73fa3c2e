// Sectors around the vehicle in words: those that no sensor watches, or that are blocked
// (docs/spec.md 3.5).
#pragma once

#include <cstdint>
#include <string>

namespace iog::tools {

// "90 to 129, -129 to -90 degrees", counter-clockwise from straight ahead; "none", or "all around".
[[nodiscard]] std::string words_of_sectors(std::uint64_t sectors);

}  // namespace iog::tools
