#include "tools/formats/picture/grid_picture.hpp"

#include <algorithm>
#include <cmath>
#include <string>

#include "geometry/grid.hpp"
#include "tools/vehicles/vehicle_catalogue.hpp"

namespace iog::tools {
namespace {

// Dark blue-grey to pale blue for free, orange to vermilion for occupied: told apart with every
// kind of colour vision, and in grey.
constexpr Colour kUnknown{30, 33, 38};
constexpr Colour kFreeWeak{74, 96, 118};
constexpr Colour kFreeStrong{206, 224, 236};
constexpr Colour kOccupiedWeak{238, 120, 20};
constexpr Colour kOccupiedStrong{178, 12, 0};
constexpr Colour kInk{235, 235, 230};
constexpr Colour kRing{150, 160, 170};
constexpr Colour kCar{250, 250, 250};
constexpr Colour kSensor{20, 170, 150};

constexpr int kWholeGridM = geometry::kCellsPerSide * geometry::kCellMm / 2000;
constexpr int kCellsPerMetre = 1000 / geometry::kCellMm;

// From metres in the vehicle frame to pixels.
class Painter {
 public:
  Painter(const GridFrame& frame, const PictureScale& scale)
      : frame_(&frame),
        scale_(scale.pixels_per_cell),
        cells_(scale.radius_m >= kWholeGridM ? geometry::kCellsPerSide
                                             : 2 * scale.radius_m * kCellsPerMetre),
        canvas_(cells_ * scale_, cells_ * scale_, kUnknown) {}

  Canvas paint() {
    paint_cells();
    paint_rings();
    if (const CatalogueEntry* const car = vehicle_of_id(frame_->header.vehicle_id)) {
      paint_car(*car);
    }
    paint_texts();
    return canvas_;
  }

 private:
  [[nodiscard]] double pixels(double metres) const { return metres * kCellsPerMetre * scale_; }
  [[nodiscard]] double column(double y_m) const { return canvas_.width() / 2.0 - pixels(y_m); }
  [[nodiscard]] double row(double x_m) const { return canvas_.height() / 2.0 - pixels(x_m); }

  void paint_cells() {
    const int first = (geometry::kCellsPerSide - cells_) / 2;
    for (int up = 0; up < cells_; ++up) {
      for (int left = 0; left < cells_; ++left) {
        const auto place = static_cast<std::size_t>(first + left) * geometry::kCellsPerSide +
                           static_cast<std::size_t>(first + up);
        if (frame_->cells[place] != index::kUnknown) {
          canvas_.fill((cells_ - 1 - left) * scale_, (cells_ - 1 - up) * scale_, scale_, scale_,
                       colour_of_index(frame_->cells[place]));
        }
      }
    }
  }

  void paint_rings() {
    const int reach_m = cells_ / 2 / kCellsPerMetre;
    for (int radius = 10; radius <= reach_m; radius += 10) {
      canvas_.circle(column(0), row(0), pixels(radius), kRing, 0.45);
      const std::string label = std::to_string(radius) + (radius == 10 ? " m" : "");
      canvas_.text(static_cast<int>(column(0)) + 4, static_cast<int>(row(radius)) + 3, label, kRing,
                   letter_scale());
    }
  }

  void paint_car(const CatalogueEntry& car) {
    const vehicle::FootprintConfig& body = car.description->footprint;
    const double left = column(body.y_max_m);
    const double right = column(body.y_min_m);
    const double front = row(body.x_max_m);
    const double back = row(body.x_min_m);
    canvas_.fill(static_cast<int>(left), static_cast<int>(front),
                 static_cast<int>(right - left) + 1, static_cast<int>(back - front) + 1, kCar,
                 0.85);
    const double middle = (left + right) / 2;
    const double nose = front + (right - left) * 0.6;
    canvas_.line(left, nose, middle, front, kUnknown);
    canvas_.line(middle, front, right, nose, kUnknown);
    for (const vehicle::SensorConfig& sensor : car.sensors) {
      const int size = std::max(3, scale_ * 2);
      canvas_.fill(static_cast<int>(column(sensor.mount.y_m)) - size / 2,
                   static_cast<int>(row(sensor.mount.x_m)) - size / 2, size, size, kSensor);
    }
  }

  [[nodiscard]] int letter_scale() const { return canvas_.width() >= 700 ? 2 : 1; }

  // Words on a dark ground, readable on whatever is below them.
  void put_text(int column, int row, const std::string& words, Colour colour) {
    const int scale = letter_scale();
    canvas_.fill(column - scale, row - scale, Canvas::text_width(words, scale) + scale,
                 (kGlyphRows + 2) * scale, kUnknown, 0.75);
    canvas_.text(column, row, words, colour, scale);
  }

  void paint_texts() {
    const int scale = letter_scale();
    const int line = (kGlyphRows + 4) * scale;
    const CatalogueEntry* const car = vehicle_of_id(frame_->header.vehicle_id);
    put_text(10, 10,
             "frame " + std::to_string(frame_->evidence_number) +
                 (car != nullptr ? "  " + std::string(car->vehicle->name) : ""),
             kInk);
    put_text(10, 10 + line, time_text() + "  " + sensors_text(), kRing);
    put_text(10, 10 + 2 * line, std::to_string(frame_->header.points_used) + " points used", kRing);
    const int row = canvas_.height() - 10 - 3 * line;
    paint_key("occupied", {2, 6, 10}, row, scale);
    paint_key("free", {-7, -28, -56}, row + line, scale);
    paint_key("unknown", {0, 0, 0}, row + 2 * line, scale);
  }

  void paint_key(const std::string& words, std::initializer_list<int> indexes, int row, int scale) {
    const int side = kGlyphRows * scale;
    int column = 10;
    canvas_.fill(column - 1, row - 1, 3 * side + 2, side + 2, kRing, 0.5);
    for (const int index : indexes) {
      canvas_.fill(column, row, side, side, colour_of_index(index));
      column += side;
    }
    put_text(column + 4 * scale, row, words, kInk);
  }

  [[nodiscard]] std::string time_text() const {
    const std::uint64_t milliseconds = frame_->header.closed_us / 1000;
    std::string fraction = std::to_string(milliseconds % 1000);
    fraction.insert(0, 3 - fraction.size(), '0');
    return std::to_string(milliseconds / 1000) + "." + fraction + " s";
  }

  // One sign per sensor: its number if it has delivered its scan, + a part of it, - nothing.
  [[nodiscard]] std::string sensors_text() const {
    std::string text = "sensors ";
    for (unsigned i = 0; i < frame_->header.sensor_count; ++i) {
      const bool is_complete = (frame_->header.complete_sensors >> i & 1) != 0;
      const bool is_partial = (frame_->header.partial_sensors >> i & 1) != 0;
      text += is_complete ? std::to_string(i) : (is_partial ? "+" : "-");
    }
    return text;
  }

  static constexpr int kGlyphRows = 7;

  const GridFrame* frame_;
  int scale_;
  int cells_;  // on a side of the picture
  Canvas canvas_;
};

}  // namespace

Colour colour_of_index(double index) {
  // A beam is worth -14 and a hit +2: these indexes give half and full strength of colour.
  constexpr double kFull = 56;
  constexpr double kFullHit = 10;
  if (index == index::kUnknown) {
    return kUnknown;
  }
  if (index < 0) {
    return mixed(kFreeWeak, kFreeStrong, std::sqrt(std::min(1.0, -index / kFull)));
  }
  return mixed(kOccupiedWeak, kOccupiedStrong, std::min(1.0, index / kFullHit));
}

Canvas picture_of(const GridFrame& frame, const PictureScale& scale) {
  return Painter(frame, scale).paint();
}

}  // namespace iog::tools
