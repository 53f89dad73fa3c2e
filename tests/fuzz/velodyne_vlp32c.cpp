// The decoder of a Velodyne VLP-32C, and what tells it from other units.
#include "lidar/velodyne_vlp32c.hpp"

#include "velodyne.hpp"

int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  using namespace iog;
  fuzz::check_velodyne<lidar::VelodyneVlp32c>(data, size);
  return 0;
}
