#include "tools/formats/picture/class_picture.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <string>
#include <utility>

#include "geometry/grid.hpp"
#include "tools/formats/picture/font.hpp"
#include "tools/vehicles/vehicle_catalogue.hpp"

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
    {240, 230, 120},  // occupied, unclassified
}};

constexpr auto kRow = static_cast<int>(geometry::kCellsPerSide);
constexpr int kMostShown = 1020;   // cells of a side of all of the window
constexpr int kSmallestThing = 3;  // pixels; a smaller one is not seen among free cells

// What is painted over what.
enum class Coat : std::uint8_t { kGround, kOccupied, kStanding, kMoving };

Coat coat_of(Class what) {
  switch (what) {
    case Class::kMoving:
      return Coat::kMoving;
    case Class::kStopped:
    case Class::kStoppedOrUnmapped:
    case Class::kInfrastructure:
      return Coat::kStanding;
    case Class::kOccupied:
      return Coat::kOccupied;
    default:
      return Coat::kGround;
  }
}

Class class_of(std::int8_t byte) {
  return static_cast<Class>(stream::class_of(static_cast<std::byte>(byte)));
}

// From cells of the window to pixels.
class ClassPainter {
 public:
  ClassPainter(const ClassGrid& classes, const FrameTitle& title, const PictureScale& scale)
      : classes_(&classes),
        title_(title),
        cells_in_metre_(1000 / classes.cell_mm),
        longest_(std::max(classes.extent.cells().width, classes.extent.cells().height)),
        side_(scale.radius_m == 0 ? std::min(longest_, kMostShown)
                                  : std::min(longest_, 2 * scale.radius_m * cells_in_metre_)),
        scale_(scale.pixels_of_cell(side_)),
        canvas_(side_ * scale_, side_ * scale_, kNothing) {
    if (has_car()) {
      x_ = first_around(car_x());
      y_ = first_around(car_y());
    } else {
      x_ = (longest_ - side_) / 2;
      y_ = x_;
    }
  }

  Canvas paint() {
    for (const Coat coat : {Coat::kGround, Coat::kOccupied, Coat::kStanding, Coat::kMoving}) {
      paint_cells(coat);
    }
    if (has_car()) {
      paint_car();
    }
    paint_legend();
    paint_bar();
    return canvas_;
  }

 private:
  [[nodiscard]] bool has_car() const { return classes_->window.has_place(); }
  [[nodiscard]] const pose::Pose& pose() const { return classes_->window.pose; }
  // In cells of the window.
  [[nodiscard]] double car_x() const {
    return static_cast<double>(pose().x_mm) / classes_->cell_mm -
           classes_->window.corner_a * double{geometry::kTileSide};
  }
  [[nodiscard]] double car_y() const {
    return static_cast<double>(pose().y_mm) / classes_->cell_mm -
           classes_->window.corner_b * double{geometry::kTileSide};
  }
  [[nodiscard]] int first_around(double middle) const {
    return std::clamp(static_cast<int>(middle) - side_ / 2, 0, longest_ - side_);
  }
  [[nodiscard]] double column(double x) const { return (x - x_) * scale_; }
  [[nodiscard]] double row(double y) const { return canvas_.height() - (y - y_) * scale_; }

  void paint_cells(Coat coat) {
    const int side = coat == Coat::kGround ? scale_ : std::max(scale_, kSmallestThing);
    const int margin = (side - scale_) / 2;
    for (int up = 0; up < side_; ++up) {
      for (int right = 0; right < side_; ++right) {
        const std::int8_t byte = classes_->cells[static_cast<std::size_t>(y_ + up) * kRow +
                                                 static_cast<std::size_t>(x_ + right)];
        if (byte != 0 && coat_of(class_of(byte)) == coat) {
          canvas_.fill(right * scale_ - margin, (side_ - 1 - up) * scale_ - margin, side, side,
                       colour_of_class(byte));
        }
      }
    }
  }

  // A place in the vehicle frame, in pixels.
  [[nodiscard]] std::pair<double, double> seen_from_above(double x_m, double y_m) const {
    const double angle = pose().heading * std::numbers::pi / 0x1p31;
    const double forward = x_m * cells_in_metre_;
    const double left = y_m * cells_in_metre_;
    return {column(car_x() + forward * std::cos(angle) - left * std::sin(angle)),
            row(car_y() + forward * std::sin(angle) + left * std::cos(angle))};
  }

  void draw(std::pair<double, double> from, std::pair<double, double> to, Colour colour) {
    canvas_.line(from.first, from.second, to.first, to.second, colour);
  }

  void paint_arrow(const description::FootprintConfig& body, Colour colour) {
    const auto nose = seen_from_above(body.x_max_m, (body.y_min_m + body.y_max_m) / 2);
    const auto left = seen_from_above(body.x_min_m, body.y_max_m);
    const auto right = seen_from_above(body.x_min_m, body.y_min_m);
    draw(left, right, colour);
    draw(left, nose, colour);
    draw(right, nose, colour);
  }

  // Every pixel in it, by steps of less than one; the arrow shows where its front is.
  void paint_body(const description::FootprintConfig& body) {
    const double step_m = 0.5 / (cells_in_metre_ * scale_);
    for (double x = body.x_min_m; x <= body.x_max_m; x += step_m) {
      draw(seen_from_above(x, body.y_min_m), seen_from_above(x, body.y_max_m), kBody);
    }
    paint_arrow(body, kNothing);
  }

  void paint_car() {
    const CatalogueEntry* const car = vehicle_of_id(title_.vehicle_id);
    if (car != nullptr) {
      paint_body(car->description->footprint);
    } else {
      paint_arrow({.x_min_m = -2, .x_max_m = 2, .y_min_m = -0.9, .y_max_m = 0.9}, kBody);
    }
    canvas_.circle(column(car_x()), row(car_y()), 10.0 * cells_in_metre_ * scale_, kFrame, 0.45);
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
    const auto& in_use = classes_->end.map.in_use;
    return std::string(in_use ? in_use->words() : std::string_view());
  }

  void paint_legend() {
    const int scale = letter_scale();
    const int line = (kGlyphHeight + 4) * scale;
    const int side = kGlyphHeight * scale;
    put_words(10, 10, words_of(title_));
    put_words(10, 10 + line, has_car() ? "circle: 10 m around the car" : "no pose, so no classes");
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

  // As long as can be read, and a quarter of the picture at most.
  void paint_bar() {
    int metres = 1;
    for (const int longer : {2, 5, 10, 20, 50, 100}) {
      metres = longer * cells_in_metre_ * 4 <= side_ ? longer : metres;
    }
    const int scale = letter_scale();
    const int length = metres * cells_in_metre_ * scale_;
    const int right = canvas_.width() - 10;
    const int bottom = canvas_.height() - 10;
    canvas_.fill(right - length, bottom - 2 * scale, length, 2 * scale, kWords);
    for (const int end : {right - length, right - scale}) {
      canvas_.fill(end, bottom - 6 * scale, scale, 6 * scale, kWords);
    }
    const std::string words = std::to_string(metres) + " m";
    put_words(right - length / 2 - Canvas::text_width(words, scale) / 2,
              bottom - (kGlyphHeight + 9) * scale, words);
  }

  const ClassGrid* classes_;
  FrameTitle title_;
  int cells_in_metre_;
  int longest_;  // side of the window, cells
  int side_;     // cells on a side of the picture
  int scale_;
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
      "unknown",  "drivable",       "free, not drivable",    "free", "moving", "stopped",
      "standing", "infrastructure", "occupied, unclassified"};
  const char* const name = kNames.at(static_cast<std::size_t>(what));
  return name;
}

Canvas picture_of(const ClassGrid& classes, const FrameTitle& title, const PictureScale& scale) {
  return ClassPainter(classes, title, scale).paint();
}

}  // namespace iog::tools
