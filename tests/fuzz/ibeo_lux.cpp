// IbeoLux on two messages, one after the other.
#include "lidar/ibeo_lux.hpp"

#include <algorithm>
#include <vector>

#include "law.hpp"
#include "tools/formats/lux/lux_scan.hpp"
#include "tools/program/exit_status.hpp"

namespace iog::fuzz {
namespace {

std::vector<lidar::ScanPoint> points_of(const lidar::IbeoLux& decoder) {
  std::vector<lidar::ScanPoint> points;
  decoder.for_each_point([&](const lidar::ScanPoint& point) {
    law(point.azimuth_ticks < lidar::IbeoLux::kTicksPerTurn, "an azimuth is within a turn");
    law(point.layer < lidar::IbeoLux::kElevationsDeg.size(), "a layer has an elevation");
    law(point.echo < lidar::IbeoLux::kMaxEchoes, "an echo is one of three");
    points.push_back(point);
  });
  law(points.size() == decoder.info().point_count, "as many points as it says");
  return points;
}

bool same(const lidar::ScanPoint& a, const lidar::ScanPoint& b) {
  return a.range_mm == b.range_mm && a.azimuth_ticks == b.azimuth_ticks && a.layer == b.layer &&
         a.echo == b.echo && a.is_ground == b.is_ground && a.is_dirt == b.is_dirt &&
         a.is_rain == b.is_rain;
}

bool tools_accept(std::span<const std::byte> message) {
  try {
    static_cast<void>(tools::parse_lux_message(message));
    return true;
  } catch (const tools::UsageError&) {
    return false;
  }
}

void check(std::span<const std::byte> first, std::span<const std::byte> second) {
  lidar::IbeoLux used;
  static_cast<void>(used.decode(first));
  lidar::IbeoLux fresh;
  const lidar::DecodeStatus status = fresh.decode(second);
  law(used.decode(second) == status, "the message before has no influence");
  law(tools_accept(second) == (status == lidar::DecodeStatus::kOk),
      "the PC reads what the target reads");
  if (status != lidar::DecodeStatus::kOk) {
    return;
  }
  const auto points = points_of(fresh);
  const auto again = points_of(used);
  law(std::ranges::equal(points, again, same), "nor on the points");
}

}  // namespace
}  // namespace iog::fuzz

int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  iog::wire::ByteReader in(iog::fuzz::input_bytes(data, size));
  const auto first = iog::fuzz::next_piece(in);
  iog::fuzz::check(first, in.bytes(in.remaining()));
  return 0;
}
