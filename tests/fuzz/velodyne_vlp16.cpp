// The decoder of a Velodyne VLP-16, and what tells it from other units.
#include "lidar/velodyne_vlp16.hpp"

#include "velodyne.hpp"

int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  using namespace iog;
  fuzz::check_velodyne<lidar::VelodyneVlp16>(data, size);
  return 0;
}
