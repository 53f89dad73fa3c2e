// Clouds as a car's unit of points would send them (docs/spec.md, section 1.2.6).
#pragma once

#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

#include "tools/clouds/cloud_fields.hpp"
#include "tools/clouds/cloud_order.hpp"
#include "tools/clouds/turn_parts.hpp"
#include "tools/formats/capture/datagram.hpp"
#include "tools/formats/points/points_writer.hpp"
#include "tools/vehicles/vehicle_catalogue.hpp"

namespace iog::tools {

// Counts of what was given and what became of it.
struct SentClouds {
  std::uint64_t given = 0;   // clouds
  std::uint64_t clouds = 0;  // that were sent
  std::uint64_t points = 0;  // that were sent
  std::uint64_t datagrams = 0;
  std::uint64_t beyond_layers = 0;     // points: sent, but the target does not use them
  std::uint64_t not_finite = 0;        // points: not sent (SeenCloud::not_finite)
  std::uint64_t nowhere = 0;           // points: not sent (SeenCloud::nowhere)
  std::uint64_t beyond_width = 0;      // points: not sent (SeenCloud::outside)
  std::uint64_t without_stamp = 0;     // clouds: it is 0
  std::uint64_t same_stamps = 0;       // clouds: it is that of the one before
  std::uint64_t without_times = 0;     // clouds of a spinning unit: their points have none
  std::uint64_t parts_of_turns = 0;    // clouds of a spinning unit (TurnParts)
  std::uint64_t wrong_times = 0;       // scans: SeenCloud::has_wrong_times
  std::uint64_t at_once = 0;           // scans: SeenCloud::is_at_once
  std::uint64_t at_range_max = 0;      // beams: SeenCloud::at_range_max
  std::uint64_t other_clock = 0;       // clouds: SeenCloud::apart_us
  double apart_us = 0;                 // SeenCloud's, of the first one of these
  double longest_span = 0;             // of a cloud's points, in their own unit
  std::uint64_t first_us = 0;          // time of the first cloud that was sent
  std::uint64_t last_us = 0;           // and of the last one
  std::uint64_t out_of_order = 0;      // clouds: not sent
  std::uint64_t strays = 0;            // clouds: not sent (CloudOrder::strays)
  std::uint64_t furthest_back_us = 0;  // CloudOrder's

  // From cloud to cloud; 0 if there is only one.
  [[nodiscard]] double period_us() const {
    return clouds < 2 ? 0
                      : static_cast<double>(last_us - first_us) / static_cast<double>(clouds - 1);
  }
  // Rounded up.
  [[nodiscard]] std::uint64_t furthest_back_ms() const { return (furthest_back_us + 999) / 1000; }
};

class PointsSender {
 public:
  // The car outlives it. `sensor` is the number of one of its sensors, which is a unit of points.
  PointsSender(const CatalogueEntry& car, std::size_t sensor);

  // Returns the datagrams of the scans that are now known to be in order of time: a scan may have
  // to wait for the next one, and some are skipped (cloud_order.hpp). A datagram's time is that of
  // its last point, and times do not fall. The points of a scan are in the order of their times or,
  // if they have none, of their azimuths, without those outside of the field of view. UsageError if
  // the scan has more points than the car file allows, for the reasons of demand_metres() and
  // CloudOrder, or if scans are in two frames.
  [[nodiscard]] std::vector<CapturedDatagram> send(SeenCloud&& cloud);

  // After the last scan: returns the datagrams of the one that waits.
  [[nodiscard]] std::vector<CapturedDatagram> finish();

  // UsageError if more scans were skipped because they are out of order than were sent.
  void demand_order() const;

  [[nodiscard]] const SentClouds& sent() const { return sent_; }

 private:
  void demand_one_frame(const std::string& frame);
  [[nodiscard]] std::vector<CapturedDatagram> datagrams_of_all(std::vector<SeenCloud>&& clouds);
  void add_datagrams(SeenCloud&& cloud, std::vector<CapturedDatagram>& datagrams);
  [[nodiscard]] PointsSector field() const;  // that the car's file has the sensor watch
  [[nodiscard]] PointsScan scan_of(SeenCloud&& cloud) const;

  const description::SensorConfig* config_;
  const vehicle::Sensor* sensor_;
  std::string frame_{};  // of the clouds
  CloudOrder order_;
  TurnParts turns_{};
  std::uint64_t last_us_ = 0;
  SentClouds sent_;
};

}  // namespace iog::tools
