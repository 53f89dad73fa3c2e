#include "tools/clouds/cloud_conversion.hpp"

#include <algorithm>
#include <limits>

#include "tools/poses/pose_log.hpp"
#include "tools/program/exit_status.hpp"

namespace iog::tools {
namespace {

constexpr std::uint64_t kPosePeriodUs = 10'000;

}  // namespace

CloudConversion::CloudConversion(const std::string& folder, const CatalogueEntry& car,
                                 std::size_t sensor, double mount_x_m, double mount_y_m)
    : car_(&car),
      sensor_(&car.sensors[sensor]),
      set_(read_cloud_set(folder)),
      head_(set_.forward, set_.times),
      track_(set_.poses),
      packets_(*sensor_, head_) {
  make_samples(mount_x_m, mount_y_m);
  set_.remarks.insert(set_.remarks.end(), set_.poses.remarks.begin(), set_.poses.remarks.end());
}

// Poses of the unit become poses of the car by its mount.
void CloudConversion::make_samples(double mount_x_m, double mount_y_m) {
  if (track_.is_empty()) {
    return;
  }
  PoseLog even;
  even.poses = track_.every(kPosePeriodUs);
  PoseConversion conversion{.mount_x_m = mount_x_m, .mount_y_m = mount_y_m};
  if (set_.poses.is_of_unit) {
    conversion.mount_x_m = sensor_->mount.x_m;
    conversion.mount_y_m = sensor_->mount.y_m;
    conversion.mount_yaw_rad = sensor_->mount.yaw_deg * kRadians;
  }
  ConvertedLog log = converted(std::move(even), conversion);
  samples_ = std::move(log.samples);
  set_.remarks.insert(set_.remarks.end(), log.remarks.begin(), log.remarks.end());
  set_.remarks.insert(set_.remarks.end(), log.notes.begin(), log.notes.end());
}

std::vector<CapturedDatagram> CloudConversion::next() {
  for (; next_cloud_ < set_.clouds.size(); ++next_cloud_) {
    if (set_.clouds[next_cloud_].empty()) {
      continue;
    }
    const ForwardTime& its = set_.forward[next_cloud_];
    std::vector<CapturedDatagram> packets =
        packets_.add(its.turn, read_cloud(set_.clouds[next_cloud_]),
                     [this](const CloudPoint& point, double time_us) {
                       return seen_at(set_, next_cloud_, point, time_us);
                     });
    ++clouds_read_;
    const std::uint64_t finite = fates().seen() - fates().not_finite;
    if (2 * fates().out_of_range > finite) {
      throw UsageError(set_.clouds[next_cloud_] + ": " + std::to_string(fates().out_of_range) +
                       " of " + std::to_string(finite) + " points are beyond the range of " +
                       std::string(sensor_->name) + "; coordinates are metres");
    }
    if (2 * packets_.sure() < finite) {
      throw UsageError(set_.clouds[next_cloud_] + ": only " + std::to_string(packets_.sure()) +
                       " of " + std::to_string(finite) + " points are where the lasers of " +
                       std::string(sensor_->name) + " look: the car's table is of another unit");
    }
    if (!packets.empty()) {
      ++next_cloud_;
      return with_poses(std::move(packets));
    }
  }
  if (std::exchange(is_over_, true)) {
    return {};
  }
  std::vector<CapturedDatagram> rest = with_poses(packets_.finish());
  add_poses_until(std::numeric_limits<std::uint64_t>::max(), rest);
  return rest;
}

void CloudConversion::add_poses_until(std::uint64_t time_us,
                                      std::vector<CapturedDatagram>& datagrams) {
  for (; next_sample_ < samples_.size() && samples_[next_sample_].time_us <= time_us;
       ++next_sample_) {
    datagrams.push_back(encoder_.datagram_of(samples_[next_sample_]));
    datagrams.back().destination.port = car_->vehicle->poses.udp_port;
  }
}

std::vector<CapturedDatagram> CloudConversion::with_poses(std::vector<CapturedDatagram> packets) {
  std::vector<CapturedDatagram> datagrams;
  for (CapturedDatagram& packet : packets) {
    add_poses_until(packet.time_us, datagrams);
    datagrams.push_back(std::move(packet));
  }
  return datagrams;
}

}  // namespace iog::tools
