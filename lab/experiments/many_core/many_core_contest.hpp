// The many-core paper's two approaches side by side: cell by cell (CBC) and beam by beam (BBB) on
// the same scans.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "lab/experiments/experiment.hpp"
#include "lab/reference/many_core.hpp"

namespace iog::lab {

// On a grid of 50 m x 30 m: 50 m ahead of the vehicle's origin, 15 m to either side.
class Contest {
 public:
  explicit Contest(double cell_m);

  // One frame by both approaches.
  void run(std::span<const reference::PlaneScan> scans);

  // Time of CBC by time of BBB on this PC: both in turns, the median of some rounds.
  [[nodiscard]] double time_ratio(std::span<const reference::PlaneScan> scans);

  [[nodiscard]] double cell_m() const { return grid_.cell_m; }
  // Sums of all frames.
  [[nodiscard]] const reference::Operations& cbc() const { return cbc_; }
  [[nodiscard]] const reference::Operations& bbb() const { return bbb_; }
  [[nodiscard]] std::uint64_t differing_cells() const { return differing_cells_; }

 private:
  reference::Operations run_cells(std::span<const reference::PlaneScan> scans);
  reference::Operations run_beams(std::span<const reference::PlaneScan> scans);

  reference::PlaneGrid grid_;
  reference::AnalyticModel model_ = reference::lux_model();
  std::vector<double> by_cells_;
  std::vector<double> by_beams_;
  reference::Operations cbc_;
  reference::Operations bbb_;
  std::uint64_t differing_cells_ = 0;
};

// The two sizes of cells that the paper has.
struct Contests {
  Contest fine{0.1};
  Contest coarse{0.2};
  std::uint32_t frames = 0;
};

struct DriveOutcome {
  Contests contests;
  double fine_time_ratio = 0;  // on this PC
  double coarse_time_ratio = 0;
};

// The front left and the front right scanner of the reference car, in every fifth frame of the
// simulated drive; both approaches are timed in the first.
[[nodiscard]] DriveOutcome contest_on_drive(const Input& input);

}  // namespace iog::lab
