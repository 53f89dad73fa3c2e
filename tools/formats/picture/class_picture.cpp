#include "tools/formats/picture/class_picture.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <string>

#include "geometry/grid.hpp"
#include "tools/formats/picture/font.hpp"

namespace iog::tools {
namespace {

using decision::Class;

constexpr Colour kNothing{30, 33, 38};
constexpr Colour kWords{235, 235, 230};
constexpr Colour kFrame{150, 160, 170};
constexpr Colour kBody{250, 250, 250};

// Free is blue, green where one may drive; what moves is magenta, what stands is brown to yellow:
// told apart with every kind of colour vision, since their brightness differs, too.
constexpr std::array<Colour, stream::kClassCount> kClassColours{{
    {30, 33, 38},     // unknown
    {150, 214, 170},  // drivable
    {120, 150, 130},  // non-drivable
    {172, 200, 222},  // free
    {255, 40, 160},   // moving
    {250, 190, 40},   // stopped
    {214, 120, 40},   // stopped or unmapped
    {140, 80, 40},    // infrastructure
    {240, 230, 120},  // occupied, not yet known by what
}};

constexpr auto kSides = static_cast<int>(geometry::kCellsPerSide);
constexpr int kCellsInMetre = 1000 / geometry::kCellMm;
constexpr int kSmallestMover = 3;  // pixels

Class class_of(std::int8_t byte) {
  return static_cast<Class>(stream::class_of(static_cast<std::byte>(byte)));
}

// From cells of the window to pixels.
class ClassPainter {
 public:
  ClassPainter(const ClassGrid& classes, std::uint64_t number, const PictureScale& scale)
      : classes_(&classes),
        number_(number),
        scale_(scale.pixels_per_cell),
        side_(std::min(kSides, 2 * scale.radius_m * kCellsInMetre)),
        canvas_(side_ * scale_, side_ * scale_, kNothing) {
    if (has_car()) {
      x_ = first_around(car_x());
      y_ = first_around(car_y());
    } else {
      x_ = (kSides - side_) / 2;
      y_ = x_;
    }
  }

  Canvas paint() {
    paint_cells(false);
    paint_cells(true);
    if (has_car()) {
      paint_car();
    }
    paint_legend();
    return canvas_;
  }

 private:
  [[nodiscard]] bool has_car() const { return classes_->window.has_place(); }
  [[nodiscard]] const pose::Pose& pose() const { return classes_->window.pose; }
  // In cells of the window.
  [[nodiscard]] double car_x() const {
    return static_cast<double>(pose().x_mm) / geometry::kCellMm -
           classes_->window.corner_a * double{geometry::kTileSide};
  }
  [[nodiscard]] double car_y() const {
    return static_cast<double>(pose().y_mm) / geometry::kCellMm -
           classes_->window.corner_b * double{geometry::kTileSide};
  }
  [[nodiscard]] int first_around(double middle) const {
    return std::clamp(static_cast<int>(middle) - side_ / 2, 0, kSides - side_);
  }
  [[nodiscard]] double column(double x) const { return (x - x_) * scale_; }
  [[nodiscard]] double row(double y) const { return canvas_.height() - (y - y_) * scale_; }

  void paint_cells(bool is_of_movers) {
    const int side = is_of_movers ? std::max(scale_, kSmallestMover) : scale_;
    const int margin = (side - scale_) / 2;
    for (int up = 0; up < side_; ++up) {
      for (int right = 0; right < side_; ++right) {
        const std::int8_t byte = classes_->cells[static_cast<std::size_t>(y_ + up) * kSides +
                                                 static_cast<std::size_t>(x_ + right)];
        if (byte != 0 && (class_of(byte) == Class::kMoving) == is_of_movers) {
          canvas_.fill(right * scale_ - margin, (side_ - 1 - up) * scale_ - margin, side, side,
                       colour_of_class(byte));
        }
      }
    }
  }

  // An arrow, 4 m long.
  void paint_car() {
    const double angle = pose().heading * std::numbers::pi / 0x1p31;
    const double half = 2.0 * kCellsInMetre;
    const auto at = [&](double forward, double left) {
      return std::pair{column(car_x() + forward * std::cos(angle) - left * std::sin(angle)),
                       row(car_y() + forward * std::sin(angle) + left * std::cos(angle))};
    };
    const auto draw = [&](std::pair<double, double> from, std::pair<double, double> to) {
      canvas_.line(from.first, from.second, to.first, to.second, kBody);
    };
    draw(at(-half, 9), at(half, 0));
    draw(at(-half, -9), at(half, 0));
    draw(at(-half, 9), at(-half, -9));
    canvas_.circle(column(car_x()), row(car_y()), 10.0 * kCellsInMetre * scale_, kFrame, 0.45);
  }

  [[nodiscard]] int letter_scale() const { return canvas_.width() >= 700 ? 2 : 1; }

  void put_words(int column, int row, const std::string& words) {
    const int scale = letter_scale();
    canvas_.fill(column - scale, row - scale, Canvas::text_width(words, scale) + scale,
                 (kGlyphHeight + 2) * scale, kNothing, 0.75);
    canvas_.text(column, row, words, kWords, scale);
  }

  // Whose the map is.
  [[nodiscard]] std::string attribution() const {
    const auto& map = classes_->end.map;
    return std::string(map && map->in_use ? map->in_use->words() : std::string_view());
  }

  void paint_legend() {
    const int scale = letter_scale();
    const int line = (kGlyphHeight + 4) * scale;
    const int side = kGlyphHeight * scale;
    put_words(10, 10, "frame " + std::to_string(number_));
    put_words(10, 10 + line, has_car() ? "circle: 10 m around the car" : "the car has no place");
    if (const std::string map = attribution(); !map.empty()) {
      put_words(10, 10 + 2 * line, "map: " + map);
    }
    int row = canvas_.height() - 10 - int{stream::kClassCount} * line;
    for (std::size_t what = 0; what < stream::kClassCount; ++what, row += line) {
      canvas_.fill(9, row - 1, side + 2, side + 2, kFrame, 0.5);
      canvas_.fill(10, row, side, side, kClassColours[what]);
      put_words(10 + side + 4 * scale, row, name_of_class(static_cast<Class>(what)));
    }
  }

  const ClassGrid* classes_;
  std::uint64_t number_;
  int scale_;
  int side_;   // cells on a side of the picture
  int x_ = 0;  // the first of them
  int y_ = 0;
  Canvas canvas_;
};

}  // namespace

Colour colour_of_class(std::int8_t byte) {
  constexpr double kWeakest = 0.55;
  constexpr double kSurest = stream::kSurenessCount - 1;
  const double sureness = stream::sureness_of(static_cast<std::byte>(byte)) / kSurest;
  const std::size_t what = stream::class_of(static_cast<std::byte>(byte));
  return what < stream::kClassCount
             ? mixed(kNothing, kClassColours[what], kWeakest + (1 - kWeakest) * sureness)
             : kNothing;
}

const char* name_of_class(Class what) {
  constexpr std::array<const char*, stream::kClassCount> kNames{
      "unknown",  "drivable",       "free, not drivable",
      "free",     "moving",         "stopped",
      "standing", "infrastructure", "occupied, not yet known by what"};
  const char* const name = kNames.at(static_cast<std::size_t>(what));
  return name;
}

Canvas picture_of(const ClassGrid& classes, std::uint64_t number, const PictureScale& scale) {
  return ClassPainter(classes, number, scale).paint();
}

}  // namespace iog::tools
