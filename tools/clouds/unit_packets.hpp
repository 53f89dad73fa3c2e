// The packets that a Velodyne would have sent of the points of its turns.
//
// It fires on an even grid of times, all along; each point goes to that firing of its laser that is
// nearest in time to when the head looked there. So a point is off by half a firing's azimuth at
// most, 0.09 degrees of an HDL-64E at 10 Hz, and by half a unit of range.
#pragma once

#include <cstddef>
#include <cstdint>
#include <functional>
#include <limits>
#include <map>
#include <optional>
#include <utility>
#include <vector>

#include "lidar/velodyne.hpp"
#include "tools/car/description.hpp"
#include "tools/clouds/head.hpp"
#include "tools/clouds/laser_table.hpp"
#include "tools/clouds/point_cloud.hpp"
#include "tools/formats/capture/datagram.hpp"
#include "tools/formats/velodyne/data_packet.hpp"

namespace iog::tools {

// What became of points.
struct PointFates {
  std::uint64_t sent = 0;
  std::uint64_t not_finite = 0;
  std::uint64_t no_laser = 0;      // looks there, by the car's table
  std::uint64_t out_of_range = 0;  // nearer or further than the wire can say
  std::uint64_t taken = 0;         // the firings around have a point already

  [[nodiscard]] std::uint64_t seen() const {
    return sent + not_finite + no_laser + out_of_range + taken;
  }
};

// Where a point of a cloud went: of the datagram with this time, in microseconds since 1970, the
// range with this number, counted as in the packet.
struct SentPoint {
  std::size_t turn = 0;
  std::size_t point = 0;  // of its cloud
  std::uint64_t datagram_us = 0;
  std::size_t range = 0;
};

// nullptr if a sensor of that format is no Velodyne.
[[nodiscard]] const lidar::VelodyneUnit* velodyne_unit_of(lidar::Format format);

class UnitPackets {
 public:
  // The sensor and the head outlive it; it is a Velodyne.
  UnitPackets(const description::SensorConfig& sensor, const Head& head);

  // Where a point of a cloud was in the unit's frame at a time, in microseconds since 1970.
  using PlaceAt = std::function<CloudPoint(const CloudPoint& point, double time_us)>;

  // Is told where each point goes, before its packet is returned.
  using OnSent = std::function<void(const SentPoint&)>;
  void tell(OnSent on_sent) { on_sent_ = std::move(on_sent); }

  // The points of a turn. Turns rise. Returns the packets, in order, to which none of a later turn
  // can come.
  [[nodiscard]] std::vector<CapturedDatagram> add(std::size_t turn, const PointCloud& cloud,
                                                  const PlaceAt& place_at);

  // The rest.
  [[nodiscard]] std::vector<CapturedDatagram> finish();

  [[nodiscard]] const PointFates& fates() const { return fates_; }
  // Points that lie on what a laser sees: of a table that is another unit's they are few.
  [[nodiscard]] std::uint64_t sure() const { return sure_; }

 private:
  // Of an azimuth's blocks: a range of a laser.
  struct Channel {
    std::size_t number = 0;  // block by block
    double fires_us = 0;     // after the azimuth was taken
    double right = 0;        // it looks so far to the right of where the head does, in turns
  };

  [[nodiscard]] std::optional<LaserPoint> seen_near(double at_us, std::size_t turn,
                                                    const CloudPoint& point,
                                                    const PlaceAt& place_at) const;
  [[nodiscard]] std::optional<LaserPoint> seen(std::size_t turn, const CloudPoint& point,
                                               const PlaceAt& place_at) const;
  [[nodiscard]] std::uint64_t& put(std::size_t turn, std::size_t point, const LaserPoint& its);
  // A range of a packet.
  struct Slot {
    std::int64_t packet = 0;
    std::size_t block = 0;
    std::size_t channel = 0;
  };
  [[nodiscard]] Slot slot_of(const Channel& channel, std::int64_t firing) const;
  VelodyneBlocks& packet(std::int64_t number);
  [[nodiscard]] double begin_us_of(std::int64_t packet) const;
  [[nodiscard]] std::uint64_t sent_at_us(std::int64_t packet) const;
  [[nodiscard]] std::uint64_t unix_us(double us) const;
  [[nodiscard]] double seen_at_us(std::size_t turn, double right) const;
  [[nodiscard]] std::int64_t packet_at(double turns) const;
  [[nodiscard]] std::vector<CapturedDatagram> take_before(std::int64_t end);

  const description::SensorConfig* sensor_;
  const Head* head_;
  const lidar::VelodyneUnit* unit_;
  LaserTable lasers_;
  std::vector<std::vector<Channel>> channels_;  // by layer
  double block_us_;                             // from one azimuth to the next
  std::int64_t firings_;                        // azimuths of a packet
  double begin_us_;                             // of packet 0, from the head's first time
  std::int64_t first_open_ =
      std::numeric_limits<std::int64_t>::min();  // packets before it have left
  std::uint64_t left_ = 0;                       // so many
  std::map<std::int64_t, VelodyneBlocks> packets_;
  PointFates fates_;
  OnSent on_sent_;
  std::uint64_t sure_ = 0;
};

}  // namespace iog::tools
