#include "tools/simulate/scanners/lux_unit.hpp"

#include <utility>

#include "tools/formats/capture/made_capture.hpp"
#include "tools/simulate/scanners/echo_model.hpp"
#include "tools/simulate/scanners/lux_burst.hpp"
#include "tools/simulate/scanners/ray_caster.hpp"

namespace iog::tools {

LuxUnit::LuxUnit(const UnitOfDrive& unit, std::uint64_t phase_us)
    : unit_(unit), phase_us_(phase_us), scanner_(*unit.sensor) {}

std::uint32_t LuxUnit::frames_per_second() const { return kLuxFramesPerSecond; }

std::uint64_t LuxUnit::frame_end_us(std::uint32_t frame) const {
  return (std::uint64_t{frame} + 1) * kLuxPeriodUs + phase_us_;
}

double LuxUnit::still_at_s(std::uint32_t frame) const {
  return static_cast<double>(frame) / kLuxFramesPerSecond;
}

void LuxUnit::append_frame(const Scene& scene, std::uint32_t frame,
                           std::vector<SimulatedPacket>& packets) {
  const std::uint64_t end_us = frame_end_us(frame);
  double from_s = still_at_s(frame);
  double to_s = from_s;
  std::uint64_t waits_us = packets.size() * kLuxBurstGapUs;
  if (unit_.motion == Motion::kContinuous) {
    from_s = static_cast<double>(end_us - kLuxSweepUs) / 1'000'000;
    to_s = static_cast<double>(end_us) / 1'000'000;
    waits_us = 0;
  }
  const LuxScanTime time{unit_.number, frame, kDriveStartUs + end_us};
  const RayCaster rays(scene, scanner_.mount(), from_s, to_s, kLuxFarthest);
  Random random = unit_.noise_of(frame);
  LuxEchoes scan = scanner_.scan(rays, from_s, to_s, side_of_scan(time.number()), random);
  std::vector<CapturedDatagram> datagrams;
  append_lux_scan(*unit_.sensor, time, std::move(scan.points), time.end_us + waits_us, datagrams);
  auto next = scan.truth.begin();
  for (CapturedDatagram& datagram : datagrams) {
    const auto end =
        next + static_cast<std::ptrdiff_t>(parse_lux_message(datagram.payload).points.size());
    packets.push_back({std::move(datagram), {next, end}});
    next = end;
  }
}

}  // namespace iog::tools
