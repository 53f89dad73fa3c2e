#include "tools/map/block_picture.hpp"

#include <algorithm>
#include <cmath>
#include <vector>

namespace iog::tools {
namespace {

constexpr double kMaxPixels = 3'000;
constexpr double kMinPixelCm = 10;
constexpr int kFooterRows = 24;
constexpr Colour kGround{226, 232, 222};
constexpr Colour kRoadColour{250, 250, 250};
constexpr Colour kBuildingColour{110, 96, 88};
constexpr Colour kBothColour{200, 80, 60};
constexpr Colour kInk{40, 40, 40};

// Classes of pixels, row by row from the north.
class Raster {
 public:
  explicit Raster(const map::BoxCm& extent) : extent_(extent) {
    const double width = static_cast<double>(extent.high.x) - extent.low.x;
    const double height = static_cast<double>(extent.high.y) - extent.low.y;
    pixel_cm_ = std::max(kMinPixelCm, std::max(width, height) / kMaxPixels);
    columns_ = std::max(1, static_cast<int>(width / pixel_cm_));
    rows_ = std::max(1, static_cast<int>(height / pixel_cm_));
    classes_.resize(static_cast<std::size_t>(columns_) * static_cast<std::size_t>(rows_));
  }

  [[nodiscard]] int columns() const { return columns_; }
  [[nodiscard]] int rows() const { return rows_; }
  [[nodiscard]] std::uint8_t at(int column, int row) const { return classes_[place(column, row)]; }

  // A pixel belongs to the feature if its centre does.
  void draw(const map::Feature& feature) {
    const map::BoxCm box = feature.box();
    const int first = std::max(0, row_of(box.high.y));
    const int last = std::min(rows_ - 1, row_of(box.low.y));
    std::vector<std::vector<double>> crossings(
        static_cast<std::size_t>(std::max(0, last - first + 1)));
    feature.for_each_edge([&](map::PointCm from, map::PointCm to) {
      const auto [low, high] = std::minmax(from.y, to.y);
      for (int row = std::max(first, row_of(high)); row <= std::min(last, row_of(low)); ++row) {
        const double y = extent_.high.y - (row + 0.5) * pixel_cm_;
        if ((from.y <= y) != (to.y <= y)) {
          const double share = (y - from.y) / (static_cast<double>(to.y) - from.y);
          crossings[static_cast<std::size_t>(row - first)].push_back(
              from.x + (static_cast<double>(to.x) - from.x) * share);
        }
      }
    });
    for (int row = first; row <= last; ++row) {
      fill(row, crossings[static_cast<std::size_t>(row - first)],
           static_cast<std::uint8_t>(feature.kind()));
    }
  }

 private:
  [[nodiscard]] std::size_t place(int column, int row) const {
    return static_cast<std::size_t>(row) * static_cast<std::size_t>(columns_) +
           static_cast<std::size_t>(column);
  }
  [[nodiscard]] int row_of(std::int32_t y) const {
    return static_cast<int>(std::floor((static_cast<double>(extent_.high.y) - y) / pixel_cm_));
  }
  // The first column whose centre is not left of x.
  [[nodiscard]] int column_from(double x) const {
    return static_cast<int>(std::ceil((x - extent_.low.x) / pixel_cm_ - 0.5));
  }

  void fill(int row, std::vector<double>& crossings, std::uint8_t bits) {
    std::ranges::sort(crossings);
    for (std::size_t i = 0; i + 1 < crossings.size(); i += 2) {
      const int end = std::min(columns_, column_from(crossings[i + 1]));
      for (int column = std::max(0, column_from(crossings[i])); column < end; ++column) {
        classes_[place(column, row)] |= bits;
      }
    }
  }

  map::BoxCm extent_;
  double pixel_cm_;
  int columns_;
  int rows_;
  std::vector<std::uint8_t> classes_;
};

}  // namespace

Canvas picture_of(const map::Block& block) {
  Raster raster(block.extent());
  block.for_each_feature_in(block.extent(),
                            [&](const map::Feature& feature) { raster.draw(feature); });
  constexpr Colour kColours[4] = {kGround, kBuildingColour, kRoadColour, kBothColour};
  Canvas canvas(raster.columns(), raster.rows() + kFooterRows, kGround);
  for (int row = 0; row < raster.rows(); ++row) {
    for (int column = 0; column < raster.columns(); ++column) {
      canvas.set(column, row, kColours[raster.at(column, row)]);
    }
  }
  canvas.text(4, raster.rows() + 5, block.attribution(), kInk, 2);
  return canvas;
}

}  // namespace iog::tools
