#include "tools/formats/ros/mount_messages.hpp"

#include <cmath>

#include "tools/car/mount.hpp"
#include "tools/formats/ros/grid_messages.hpp"
#include "tools/formats/ros/grid_parts.hpp"

namespace iog::tools::ros {

// The quaternion of Rz(yaw) Ry(pitch) Rx(roll), as REP 103 wants it and tools/car/mount.hpp
// turns.
std::vector<std::byte> mounts_of(std::span<const description::SensorConfig> sensors,
                                 std::uint64_t stamp_us) {
  CdrWriter out;
  out.put(static_cast<std::uint32_t>(sensors.size()));
  for (const description::SensorConfig& sensor : sensors) {
    const description::MountConfig& mount = sensor.mount;
    const double yaw = description::radians(mount.yaw_deg) / 2;
    const double pitch = description::radians(mount.pitch_deg) / 2;
    const double roll = description::radians(mount.roll_deg) / 2;
    const double cy = std::cos(yaw);
    const double sy = std::sin(yaw);
    const double cp = std::cos(pitch);
    const double sp = std::sin(pitch);
    const double cr = std::cos(roll);
    const double sr = std::sin(roll);
    put_stamp(out, stamp_us);
    out.put(kFrameId);
    out.put(sensor.name);
    for (const double value :
         {mount.x_m, mount.y_m, mount.z_m, sr * cp * cy - cr * sp * sy, cr * sp * cy + sr * cp * sy,
          cr * cp * sy - sr * sp * cy, cr * cp * cy + sr * sp * sy}) {
      out.put(value);
    }
  }
  return out.take();
}

}  // namespace iog::tools::ros
