// A simulated ibeo LUX, of four or eight layers: 25 scans a second.
//
// A scan of 100 degrees takes 11.111 ms, from left to right, and its packets leave when it is over.
#pragma once

#include "tools/simulate/scanners/lux_scanner.hpp"
#include "tools/simulate/scanners/unit.hpp"

namespace iog::tools {

class LuxUnit final : public Unit {
 public:
  // phase_us: how much later than a whole number of periods each of its scans ends.
  LuxUnit(const UnitOfDrive& unit, std::uint64_t phase_us);

  [[nodiscard]] std::uint32_t frames_per_second() const override;
  [[nodiscard]] std::uint64_t frame_end_us(std::uint32_t frame) const override;
  [[nodiscard]] double still_at_s(std::uint32_t frame) const override;

  // If the motion is stepwise the car's LUX send one after another, and the first when its scan
  // ends: behind those that are already there.
  void append_frame(const Scene& scene, std::uint32_t frame,
                    std::vector<SimulatedPacket>& packets) override;

 private:
  UnitOfDrive unit_;
  std::uint64_t phase_us_;
  LuxScanner scanner_;
};

}  // namespace iog::tools
