#include "tools/receive/own_car_watch.hpp"

#include <algorithm>
#include <cmath>
#include <iomanip>
#include <span>
#include <sstream>

#include "tools/program/table.hpp"

namespace iog::tools {
namespace {

constexpr double kNearM = 1;    // of the footprint: parts of a car
constexpr double kAroundM = 3;  // in which larger things reach
constexpr std::size_t kRow = geometry::kCellsPerSide;
constexpr double kApartMm = 500;
constexpr std::uint32_t kFewestFrames = 40;
constexpr std::uint32_t kLeastTenths = 9;  // of the frames

}  // namespace

void OwnCarWatch::add(const GridFrame& frame) {
  if (!frame.header.has_indexes() || !frame.classes || !frame.classes->window.has_place()) {
    return;
  }
  const pose::Pose& pose = frame.classes->window.pose;
  if (frames_ > 0 &&
      std::hypot(1.0 * pose.x_mm - last_.x_mm, 1.0 * pose.y_mm - last_.y_mm) < kApartMm) {
    return;
  }
  last_ = pose;
  grid_ = frame.shape;
  cells_.resize(geometry::kCellCount);
  ++frames_;
  for (std::size_t i = kRow + 1; i + kRow + 1 < cells_.size(); ++i) {
    for (std::size_t first = i - kRow - 1; frame.cells[i] > 0 && first < i + kRow; first += kRow) {
      for (Cell& cell : std::span(cells_).subspan(first, 3)) {
        cell.frames += cell.last_frame < frames_ ? 1U : 0U;
        cell.last_frame = frames_;
      }
    }
  }
}

std::string OwnCarWatch::row_of_footprint() const {
  std::vector<double> xs_m;
  std::vector<double> ys_m;
  for (std::size_t i = 0; frames_ >= kFewestFrames && i < cells_.size(); ++i) {
    const geometry::Cell cell = geometry::cell_of(i);
    const double x_m = (cell.x - grid_.origin_column + 0.5) * grid_.cell_mm / 1000;
    const double y_m = (cell.y - grid_.origin_row + 0.5) * grid_.cell_mm / 1000;
    const double off_m = std::max(
        {body_->x_min_m - x_m, x_m - body_->x_max_m, body_->y_min_m - y_m, y_m - body_->y_max_m});
    if (off_m > kAroundM || 10 * cells_[i].frames < kLeastTenths * frames_) {
      continue;
    }
    if (off_m > kNearM) {
      return {};
    }
    xs_m.push_back(x_m);
    ys_m.push_back(y_m);
  }
  if (xs_m.empty()) {
    return {};
  }
  const auto [back, front] = std::ranges::minmax(xs_m);
  const auto [right, left] = std::ranges::minmax(ys_m);
  std::ostringstream words;
  words << std::fixed << std::setprecision(1) << "something stays at x " << back << " to " << front
        << " m, y " << right << " to " << left
        << " m while the car drives: the sensors see the car itself, so enlarge its footprint";
  return row("FOOTPRINT?", words.str());
}

}  // namespace iog::tools
