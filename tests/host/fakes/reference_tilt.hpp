// The tilt of a packet once more, after docs/ground.md: the line of least squares in exact whole
// numbers, rounded as the page says. Sums stay below 2^48.
#pragma once

#include <algorithm>
#include <vector>

#include "fakes/reference_ground.hpp"

namespace iog::tests {

struct ReferenceSample {
  Whole along_mm = 0;
  Whole height_mm = 0;
};

struct TiltRule {
  Whole first_mm = 3'000;
  Whole end_mm = 30'000;
  Whole near_mm = 100;
  Whole near_rise = 100;  // in 4,096
  Whole fits_mm = 80;
  Whole least_spread = 900;
  Whole most_up = 100;
  Whole most_slope = 656;
  Whole better = 8;  // one more of so many must fit
};

struct ReferenceTilt {
  Whole up_mm = 0;
  Whole slope = 0;
  [[nodiscard]] Whole at(Whole along_mm) const {
    return up_mm + floor_of(slope * along_mm, 16'384);
  }
};

class ReferenceLine {
 public:
  explicit ReferenceLine(TiltRule rule = {}) : rule_(rule) {}

  [[nodiscard]] ReferenceTilt of(const std::vector<ReferenceSample>& returns, Whole fewest) const {
    std::vector<ReferenceSample> samples;
    for (const ReferenceSample& its : returns) {
      if (its.along_mm >= rule_.first_mm && its.along_mm < rule_.end_mm) {
        samples.push_back({its.along_mm / 16, std::clamp<Whole>(its.height_mm, -32'767, 32'767)});
      }
    }
    ReferenceTilt tilt = fitted(samples, {}, rule_.near_rise, fewest);
    tilt = fitted(samples, tilt, 0, fewest);
    const Whole before = that_fit(samples, {});
    return that_fit(samples, tilt) >= before + before / rule_.better ? tilt : ReferenceTilt{};
  }

 private:
  [[nodiscard]] ReferenceTilt fitted(const std::vector<ReferenceSample>& samples,
                                     const ReferenceTilt& tilt, Whole near_rise,
                                     Whole fewest) const {
    std::vector<ReferenceSample> near;
    for (const ReferenceSample& its : samples) {
      const Whole off = its.height_mm - tilt.at(16 * its.along_mm);
      const Whole most = rule_.near_mm + floor_of(near_rise * 16 * its.along_mm, 4'096);
      if (-most <= off && off <= most) {
        near.push_back(its);
      }
    }
    // Sums over pairs are those of least squares: n sum(x^2) - sum(x)^2 is that of the squares of
    // the differences of x, each pair once.
    Whole spread = 0;
    Whole common = 0;
    for (std::size_t i = 0; i < near.size(); ++i) {
      for (std::size_t j = 0; j < i; ++j) {
        const Whole x = near[i].along_mm - near[j].along_mm;
        spread += x * x;
        common += x * (near[i].height_mm - near[j].height_mm);
      }
    }
    const auto n = static_cast<Whole>(near.size());
    if (n < fewest || spread <= rule_.least_spread * n * n) {
      return {};
    }
    ReferenceTilt its;
    its.slope =
        std::clamp<Whole>(floor_of(common * 1024, spread), -rule_.most_slope, rule_.most_slope);
    Whole sum_x = 0;
    Whole sum_y = 0;
    for (const ReferenceSample& sample : near) {
      sum_x += sample.along_mm;
      sum_y += sample.height_mm;
    }
    its.up_mm = std::clamp<Whole>(floor_of(sum_y - floor_of(its.slope * sum_x, 1024), n),
                                  -rule_.most_up, rule_.most_up);
    return its;
  }

  [[nodiscard]] Whole that_fit(const std::vector<ReferenceSample>& samples,
                               const ReferenceTilt& tilt) const {
    return std::ranges::count_if(samples, [&](const ReferenceSample& its) {
      const Whole off = its.height_mm - tilt.at(16 * its.along_mm);
      return -rule_.fits_mm <= off && off <= rule_.fits_mm;
    });
  }

  TiltRule rule_;
};

}  // namespace iog::tests
