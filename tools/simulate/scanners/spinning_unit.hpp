// A simulated unit whose head turns, ten times a second (an Ouster as it is set), or a radar with
// as many cycles: a frame is a tenth of a second. Packets come when they are full, so one may
// belong to two turns.
#pragma once

#include <memory>

#include "tools/simulate/scanners/packet_encoder.hpp"
#include "tools/simulate/scanners/sensor_frame.hpp"
#include "tools/simulate/scanners/unit.hpp"

namespace iog::tools {

class SpinningUnit final : public Unit {
 public:
  SpinningUnit(const UnitOfDrive& unit, std::unique_ptr<PacketEncoder> encoder);

  [[nodiscard]] std::uint32_t frames_per_second() const override { return kTurnsPerSecond; }
  [[nodiscard]] std::uint64_t frame_end_us(std::uint32_t frame) const override;
  // In its middle.
  [[nodiscard]] double still_at_s(std::uint32_t frame) const override;

  // The packets that begin in the frame.
  void append_frame(const Scene& scene, std::uint32_t frame,
                    std::vector<SimulatedPacket>& packets) override;

 private:
  [[nodiscard]] RayCaster rays_of(const Scene& scene, std::uint32_t frame,
                                  std::uint64_t begin_ns) const;

  UnitOfDrive unit_;
  SensorFrame mount_;  // in the vehicle
  std::unique_ptr<PacketEncoder> encoder_;
};

}  // namespace iog::tools
