// A cloud in a file of its own: PCD, the Point Cloud Library's format, version 0.7, with DATA
// ascii, binary or binary_compressed.
#pragma once

#include <cstdint>
#include <string>

#include "tools/clouds/cloud_fields.hpp"

namespace iog::tools {

// stamp_us: of the scan since 1970, which the file does not have. Sets unit as cloud_of() does.
// UsageError if the file cannot be read or is no such file, and as cloud_of().
[[nodiscard]] SeenCloud read_pcd(const std::string& path, TimeUnit& unit, std::uint64_t stamp_us);

}  // namespace iog::tools
