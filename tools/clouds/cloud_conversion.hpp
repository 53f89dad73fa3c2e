// A folder of point clouds (cloud_set.hpp) as what a car's unit and its poses would have sent.
#pragma once

#include <cstddef>
#include <string>
#include <utility>
#include <vector>

#include "tools/clouds/cloud_set.hpp"
#include "tools/clouds/track.hpp"
#include "tools/clouds/unit_packets.hpp"
#include "tools/formats/capture/datagram.hpp"
#include "tools/poses/pose_encoder.hpp"
#include "tools/vehicles/vehicle_catalogue.hpp"

namespace iog::tools {

class CloudConversion {
 public:
  // The car outlives it, and its sensor is a Velodyne. mount_x_m, mount_y_m: where in the vehicle
  // frame the receiver of the poses is, in metres; poses of the unit itself need none.
  // UsageError as read_cloud_set().
  CloudConversion(const std::string& folder, const CatalogueEntry& car, std::size_t sensor,
                  double mount_x_m, double mount_y_m);
  CloudConversion(const CloudConversion&) = delete;
  CloudConversion& operator=(const CloudConversion&) = delete;
  ~CloudConversion() = default;

  // Is told where each point goes, before its datagram is returned.
  void tell(UnitPackets::OnSent on_sent) { packets_.tell(std::move(on_sent)); }

  // Returns the datagrams of the next turn, in order of time, or none at the end. UsageError if a
  // cloud cannot be read, or if half of the points so far are beyond the unit's range or away from
  // the directions of the car's lasers.
  [[nodiscard]] std::vector<CapturedDatagram> next();

  [[nodiscard]] const CloudSet& set() const { return set_; }
  [[nodiscard]] const PointFates& fates() const { return packets_.fates(); }
  [[nodiscard]] std::size_t clouds_read() const { return clouds_read_; }
  [[nodiscard]] std::size_t poses() const { return samples_.size(); }

 private:
  void make_samples(double mount_x_m, double mount_y_m);
  void add_poses_until(std::uint64_t time_us, std::vector<CapturedDatagram>& datagrams);
  [[nodiscard]] std::vector<CapturedDatagram> with_poses(std::vector<CapturedDatagram> packets);

  const CatalogueEntry* car_;
  const description::SensorConfig* sensor_;
  CloudSet set_;
  Head head_;
  Track track_;
  UnitPackets packets_;
  PoseEncoder encoder_;
  std::vector<PoseSample> samples_;
  std::size_t next_cloud_ = 0;
  std::size_t clouds_read_ = 0;
  std::size_t next_sample_ = 0;
  bool is_over_ = false;
};

}  // namespace iog::tools
