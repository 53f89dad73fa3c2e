#include "tools/map/block_file.hpp"

#include <algorithm>
#include <cstddef>

#include "map/block.hpp"
#include "tools/map/refusal_text.hpp"
#include "tools/program/exit_status.hpp"
#include "tools/program/file.hpp"

namespace iog::tools {

std::vector<std::uint8_t> read_block(const std::string& path) {
  const std::vector<std::byte> bytes = read_file(path);
  std::vector<std::uint8_t> block(bytes.size());
  std::ranges::transform(bytes, block.begin(),
                         [](std::byte byte) { return std::to_integer<std::uint8_t>(byte); });
  const map::Refusal refusal = map::check(block);
  if (refusal == map::Refusal::kNotABlock || refusal == map::Refusal::kTooShort) {
    throw UsageError(path + ": not a map block; `iog map` makes one of OpenStreetMap data");
  }
  if (refusal != map::Refusal::kNone) {
    throw UsageError(path + ": the target would refuse this map: " + refusal_text(refusal));
  }
  return block;
}

}  // namespace iog::tools
