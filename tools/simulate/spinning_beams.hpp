// The beams of a simulated unit that turns: where each of its lasers looks, and what it counts.
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <vector>

#include "tools/simulate/random.hpp"
#include "tools/simulate/spinning_scanner.hpp"
#include "vehicle/description.hpp"

namespace iog::tools {

class SpinningBeams {
 public:
  // Its lasers are those of its calibration, or else those of its format.
  explicit SpinningBeams(const vehicle::SensorConfig& config);

  [[nodiscard]] std::size_t layers() const { return lasers_.size(); }

  // What a laser counts, metres, with the unit looking so far to the right of forward: ticks of the
  // format, from less than a turn below 0 upwards. Empty: nothing came back.
  [[nodiscard]] std::optional<double> measured_m(std::size_t layer, std::int32_t right_ticks,
                                                 const SpinningScanner& scanner,
                                                 Random& random) const;

 private:
  struct Laser {
    double cosine = 1;  // of its elevation
    double sine = 0;
    double height_m = 0;           // where its beam, drawn backwards, meets the unit's axis
    double range_m = 0;            // how much more it counts than the way from there
    std::int32_t right_ticks = 0;  // of where the head looks
  };

  std::vector<Laser> lasers_;          // by layer
  std::vector<double> azimuth_sines_;  // by azimuth
};

}  // namespace iog::tools
