#include "tools/identity/format_names.hpp"

#include "lidar/formats.hpp"

namespace iog::tools {

std::string names_of(const lidar::FormatSet& formats) {
  std::string names;
  for (unsigned number = 0; number < lidar::FormatSet::kMost; ++number) {
    const auto format = static_cast<lidar::Format>(number);
    if (formats.has(format)) {
      names += (names.empty() ? "" : " or ") + std::string(lidar::name_of(format));
    }
  }
  return names;
}

}  // namespace iog::tools
