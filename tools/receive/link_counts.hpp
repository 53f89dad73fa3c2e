// What became of a stream's messages, as the commands show it.
#pragma once

#include <cstdint>
#include <string>
#include <utility>
#include <vector>

#include "tools/frames/frame_assembler.hpp"

namespace iog::tools {

// "messages_lost" and how many, one after the other; named as in files of facts.
using LinkCounts = std::vector<std::pair<std::string, std::uint64_t>>;

[[nodiscard]] LinkCounts link_counts(const FrameAssembler& assembler);

// A row of a table for each that is not 0, and for those that a reader always asks for.
[[nodiscard]] std::string rows_of(const LinkCounts& counts);

}  // namespace iog::tools
