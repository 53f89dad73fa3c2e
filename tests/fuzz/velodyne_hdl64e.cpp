// The decoder of a Velodyne HDL-64E, and what tells it from other units.
#include "lidar/velodyne_hdl64e.hpp"

#include "velodyne.hpp"

int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  using namespace iog;
  fuzz::check_velodyne<lidar::VelodyneHdl64eS2, lidar::VelodyneHdl64eS3>(data, size);
  return 0;
}
