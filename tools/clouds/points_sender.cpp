#include "tools/clouds/points_sender.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

#include "lidar/points.hpp"
#include "tools/formats/capture/made_capture.hpp"
#include "tools/program/exit_status.hpp"
#include "tools/program/printable.hpp"

namespace iog::tools {

namespace {

constexpr std::uint32_t kPartsPerTurn = lidar::PointsPacket::kPartsPerTurn;

// How far the point is to the left of where the sector begins.
std::uint32_t parts_within(const PointsSector& sector, const WirePoint& point) {
  return (static_cast<std::uint32_t>(point.first) + kPartsPerTurn - sector.begin) % kPartsPerTurn;
}

}  // namespace

PointsSender::PointsSender(const CatalogueEntry& car, std::size_t sensor)
    : config_(&car.sensors[sensor]), sensor_(&car.vehicle->sensors[sensor]) {}

// What does not turn looks as far to the left as to the right.
PointsSector PointsSender::field() const {
  const std::uint64_t width =
      sensor_->scan_width_ticks * std::uint64_t{kPartsPerTurn} / sensor_->azimuths.ticks_per_turn();
  return {.begin = static_cast<std::uint32_t>((kPartsPerTurn - width / 2) % kPartsPerTurn),
          .width = static_cast<std::uint32_t>(width)};
}

PointsScan PointsSender::scan_of(SeenCloud&& cloud) const {
  const PointsSector sector = field();
  PointsScan scan{.number = static_cast<std::uint32_t>(sent_.clouds),
                  .time_us = cloud.time_us,
                  .sector_begin = sector.begin,
                  .sector_width = sector.width,
                  .points = std::move(cloud.points)};
  if (cloud.has_times) {
    std::ranges::stable_sort(scan.points, {}, &WirePoint::after_us);
  } else {
    std::ranges::stable_sort(scan.points, {},
                             [&](const WirePoint& point) { return parts_within(sector, point); });
  }
  return scan;
}

// All points are placed by one mount.
void PointsSender::demand_one_frame(const std::string& frame) {
  if (frame.empty()) {
    return;
  }
  if (!frame_.empty() && frame != frame_) {
    throw UsageError(
        "cloud " + std::to_string(sent_.given) + " is in frame " + printable(frame) +
        ", the one before in " + printable(frame_) +
        ": all clouds of a sensor are in one frame, so record each lidar on a topic of its own");
  }
  frame_ = frame;
}

void PointsSender::demand_order() const {
  if (sent_.out_of_order > sent_.clouds) {
    throw UsageError(std::to_string(sent_.out_of_order) + " of " +
                     std::to_string(sent_.out_of_order + sent_.clouds) +
                     " clouds are out of order (times go back by up to " +
                     std::to_string(sent_.furthest_back_ms()) +
                     " ms): give files in order of time, and recordings sorted by header.stamp");
  }
}

std::vector<CapturedDatagram> PointsSender::send(SeenCloud&& cloud) {
  demand_one_frame(cloud.frame);
  const PointsSector sector = field();
  // The target drops the whole datagram of such a point.
  cloud.outside = std::erase_if(cloud.points, [&](const WirePoint& point) {
    return parts_within(sector, point) > sector.width;
  });
  if (cloud.points.size() > sensor_->max_points_per_scan) {
    throw UsageError("cloud " + std::to_string(sent_.given) + " has " +
                     std::to_string(cloud.points.size()) + " points, and max_points_per_scan of " +
                     std::string(config_->name) + " is " +
                     std::to_string(sensor_->max_points_per_scan));
  }
  if (lidar::turns(sensor_->format) && cloud.view_deg < kWholeTurnDeg) {
    throw UsageError("cloud " + std::to_string(sent_.given) + " spans " +
                     std::to_string(std::lround(cloud.view_deg)) + " degrees, and " +
                     std::string(config_->name) +
                     " is of type points_turning: for less than a turn give type = \"points\" and "
                     "the scan_width_ticks of `iog info`");
  }
  demand_metres(
      static_cast<std::size_t>(std::ranges::count_if(
          cloud.points, [](std::int32_t mm) { return mm > kFarthestMm; }, &WirePoint::third)),
      cloud.points.size(), "cloud " + std::to_string(sent_.given));
  std::vector<SeenCloud> in_order = order_.take(std::move(cloud));
  ++sent_.given;
  return datagrams_of_all(std::move(in_order));
}

std::vector<CapturedDatagram> PointsSender::finish() { return datagrams_of_all(order_.finish()); }

std::vector<CapturedDatagram> PointsSender::datagrams_of_all(std::vector<SeenCloud>&& clouds) {
  std::vector<CapturedDatagram> datagrams;
  for (SeenCloud& cloud : clouds) {
    add_datagrams(std::move(cloud), datagrams);
  }
  sent_.out_of_order = order_.out_of_order();
  sent_.furthest_back_us = order_.furthest_back_us();
  sent_.strays = order_.strays();
  return datagrams;
}

void PointsSender::add_datagrams(SeenCloud&& cloud, std::vector<CapturedDatagram>& datagrams) {
  if (cloud.time_us == 0) {
    ++sent_.without_stamp;
  } else if (cloud.time_us == sent_.last_us) {
    ++sent_.same_stamps;
  }
  sent_.first_us = sent_.clouds == 0 ? cloud.time_us : sent_.first_us;
  sent_.last_us = cloud.time_us;
  sent_.longest_span = std::max(sent_.longest_span, cloud.time_span);
  sent_.not_finite += cloud.not_finite;
  sent_.nowhere += cloud.nowhere;
  sent_.beyond_width += cloud.outside;
  if (cloud.apart_us > 0 && cloud.time_us != 0 && sent_.other_clock++ == 0) {
    sent_.apart_us = cloud.apart_us;
  }
  sent_.wrong_times += cloud.has_wrong_times ? 1U : 0U;
  sent_.at_once += cloud.is_at_once ? 1U : 0U;
  sent_.at_range_max += cloud.at_range_max;
  const bool needs_times = lidar::turns(sensor_->format) && !cloud.points.empty();
  sent_.without_times += needs_times && !cloud.has_times ? 1U : 0U;
  if (lidar::turns(sensor_->format)) {
    turns_.take(cloud.points);
    sent_.parts_of_turns = turns_.parts();
  }
  sent_.points += cloud.points.size();
  const lidar::LayerSearch layers(sensor_->unit().elevations);
  sent_.beyond_layers += static_cast<std::uint64_t>(std::ranges::count_if(
      cloud.points, [&](const WirePoint& point) { return !layers.sees(point.second); }));
  const PointsScan scan = scan_of(std::move(cloud));
  ++sent_.clouds;
  const std::uint32_t source = config_->source_ipv4 != 0 ? config_->source_ipv4 : kUnnamedIpv4;
  for (PointsDatagram& made : datagrams_of(scan)) {
    last_us_ = std::max(last_us_, made.last_us);  // points are sent when they have been seen
    datagrams.push_back({.time_us = last_us_,
                         .source = {source, config_->udp_port},
                         .destination = {kTargetIpv4, config_->udp_port},
                         .payload = std::move(made.bytes)});
    ++sent_.datagrams;
  }
}

}  // namespace iog::tools
