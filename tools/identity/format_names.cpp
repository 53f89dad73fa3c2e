#include "tools/identity/format_names.hpp"

#include "lidar/formats.hpp"

namespace iog::tools {

std::string names_of(const lidar::FormatSet& formats) {
  std::string names;
  lidar::for_each_format([&](lidar::Format format, auto /*decoder*/) {
    if (formats.has(format)) {
      names += (names.empty() ? "" : " or ") + std::string(lidar::name_of(format));
    }
  });
  return names;
}

}  // namespace iog::tools
