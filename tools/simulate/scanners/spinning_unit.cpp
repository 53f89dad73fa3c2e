#include "tools/simulate/scanners/spinning_unit.hpp"

#include <utility>

#include "tools/formats/capture/made_capture.hpp"
#include "tools/simulate/scanners/ray_caster.hpp"
#include "tools/simulate/scanners/spinning_beams.hpp"

namespace iog::tools {
namespace {

constexpr std::uint64_t kFrameNs = 1'000'000'000 / kTurnsPerSecond;
// So long things are taken to move straight: at 5 m/s2 that is off by a quarter of a millimetre.
constexpr std::uint64_t kStraightNs = kFrameNs / 5;

double seconds_of(std::uint64_t ns) { return static_cast<double>(ns) / 1e9; }

}  // namespace

SpinningUnit::SpinningUnit(const UnitOfDrive& unit, std::unique_ptr<PacketEncoder> encoder)
    : unit_(unit), mount_(frame_of(unit.sensor->mount)), encoder_(std::move(encoder)) {}

std::uint64_t SpinningUnit::frame_end_us(std::uint32_t frame) const {
  return (std::uint64_t{frame} + 1) * kFrameNs / 1000;
}

double SpinningUnit::still_at_s(std::uint32_t frame) const {
  return (frame + 0.5) / kTurnsPerSecond;
}

// What the beams meet of the packets that begin in the stretch of time from begin_ns on.
RayCaster SpinningUnit::rays_of(const Scene& scene, std::uint32_t frame,
                                std::uint64_t begin_ns) const {
  if (unit_.motion == Motion::kStepwise) {
    return {scene, mount_, still_at_s(frame), still_at_s(frame), kSpinningFarthest};
  }
  return {scene, mount_, seconds_of(begin_ns),
          seconds_of(begin_ns + kStraightNs + encoder_->packet_ns()), kSpinningFarthest};
}

void SpinningUnit::append_frame(const Scene& scene, std::uint32_t frame,
                                std::vector<SimulatedPacket>& packets) {
  const description::SensorConfig& config = *unit_.sensor;
  const std::uint64_t packet_ns = encoder_->packet_ns();
  const std::uint64_t stretch_ns = unit_.motion == Motion::kStepwise ? kFrameNs : kStraightNs;
  const std::uint32_t source = config.source_ipv4 != 0 ? config.source_ipv4 : kUnnamedIpv4;
  Random random = unit_.noise_of(frame);
  std::uint64_t begin_ns = frame * kFrameNs;
  const std::uint64_t end_ns = begin_ns + kFrameNs;
  std::uint64_t number = (begin_ns + packet_ns - 1) / packet_ns;
  for (; begin_ns < end_ns; begin_ns += stretch_ns) {
    const RayCaster rays = rays_of(scene, frame, begin_ns);
    for (; number * packet_ns < begin_ns + stretch_ns; ++number) {
      SimulatedPacket& packet = packets.emplace_back();
      packet.datagram = {
          .time_us = kDriveStartUs + (number + 1) * packet_ns / 1000,
          .source = {source, config.udp_port},
          .destination = {kTargetIpv4, config.udp_port},
          .payload = encoder_->packet(number * packet_ns, number, rays, random, packet.points)};
    }
  }
}

}  // namespace iog::tools
