// The beams of a simulated unit that turns: where each of its lasers looks, what it meets there,
// and what it counts.
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <vector>

#include "tools/car/description.hpp"
#include "tools/simulate/random.hpp"
#include "tools/simulate/scanners/ray_caster.hpp"

namespace iog::tools {

inline constexpr double kSpinningFarthest = 120;  // metres; Velodyne's data sheets say 70 to 120

struct Measured {
  std::optional<double> range_m;  // as the unit counts it; none: nothing came back
  PointTruth truth{};
};

class SpinningBeams {
 public:
  // Its lasers are those of its calibration, or else those of its format.
  explicit SpinningBeams(const description::SensorConfig& config);

  [[nodiscard]] std::size_t layers() const { return lasers_.size(); }

  // What a laser counts, with the unit looking so far to the right of forward: ticks of the format,
  // from less than a turn below 0 upwards. It fires so long after the drive's begin.
  [[nodiscard]] Measured measure(std::size_t layer, std::int32_t right_ticks,
                                 std::uint64_t fires_ns, const RayCaster& rays,
                                 Random& random) const;

 private:
  struct Laser {
    double cosine = 1;  // of its elevation
    double sine = 0;
    double height_m = 0;           // where its beam, drawn backwards, meets the unit's axis
    double range_m = 0;            // how much more it counts than the way from there
    std::int32_t right_ticks = 0;  // of where the head looks
  };

  double sigma_m_;
  std::vector<Laser> lasers_;          // by layer
  std::vector<double> azimuth_sines_;  // by azimuth
};

}  // namespace iog::tools
