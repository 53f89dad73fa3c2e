// The decoder of a Velodyne HDL-32E, and what tells it from other units.
#include "lidar/velodyne_hdl32e.hpp"

#include "velodyne.hpp"

int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  using namespace iog;
  fuzz::check_velodyne<lidar::VelodyneHdl32e>(data, size);
  return 0;
}
