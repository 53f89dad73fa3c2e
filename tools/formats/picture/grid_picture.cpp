#include "tools/formats/picture/grid_picture.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <optional>

#include "geometry/grid.hpp"
#include "tools/formats/picture/font.hpp"
#include "tools/formats/picture/frame_title.hpp"
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

constexpr int kSmallestHit = 3;  // pixels; a smaller one is not seen among free cells

// The range of cells that a picture shows along an axis.
struct Shown {
  int first = 0;
  int end = 0;
  int origin = 0;  // the vehicle's

  Shown(int cells, int origin_cell, int radius_cells)
      : first(std::max(0, origin_cell - radius_cells)),
        end(std::max(first + 1, std::min(cells, origin_cell + radius_cells))),
        origin(origin_cell) {}
  [[nodiscard]] int count() const { return end - first; }
  [[nodiscard]] int reach() const { return std::max(end - origin, origin - first); }
};

// From metres in the vehicle frame to pixels.
class Painter {
 public:
  Painter(const GridFrame& frame, const PictureScale& scale)
      : frame_(&frame),
        cells_per_metre_(1000 / frame.shape.cell_mm),
        x_(frame.shape.columns, frame.shape.origin_column, radius_cells(scale)),
        y_(frame.shape.rows, frame.shape.origin_row, radius_cells(scale)),
        scale_(scale.pixels_of_cell(std::max(x_.count(), y_.count()))),
        canvas_(y_.count() * scale_, x_.count() * scale_, kUnknown) {}

  Canvas paint() {
    paint_cells(false);
    paint_rings();
    paint_cells(true);
    label_rings();
    if (const CatalogueEntry* const car = vehicle_of_id(frame_->header.vehicle_id)) {
      paint_car(*car);
    }
    paint_texts();
    return canvas_;
  }

 private:
  [[nodiscard]] int radius_cells(const PictureScale& scale) const {
    return scale.radius_m == 0 ? geometry::kLongestSide : scale.radius_m * cells_per_metre_;
  }
  [[nodiscard]] double pixels(double metres) const { return metres * cells_per_metre_ * scale_; }
  [[nodiscard]] double column(double y_m) const {
    return (y_.end - y_.origin) * scale_ - pixels(y_m);
  }
  [[nodiscard]] double row(double x_m) const { return (x_.end - x_.origin) * scale_ - pixels(x_m); }
  [[nodiscard]] int reach_m() const { return std::max(x_.reach(), y_.reach()) / cells_per_metre_; }

  // visit(place in the grid, column and row of its first pixel) for each cell of the picture.
  template <typename Visit>
  void for_each_cell(Visit&& visit) const {
    for (int x = x_.first; x < x_.end; ++x) {
      for (int y = y_.first; y < y_.end; ++y) {
        visit(static_cast<std::size_t>(geometry::number_of({x, y}, frame_->shape.columns)),
              (y_.end - 1 - y) * scale_, (x_.end - 1 - x) * scale_);
      }
    }
  }

  void paint_cells(bool is_of_hits) {
    const int side = is_of_hits ? std::max(scale_, kSmallestHit) : scale_;
    const int margin = (side - scale_) / 2;
    for_each_cell([&](std::size_t place, int column, int row) {
      const index::OccupancyIndex index = frame_->cells[place];
      if (is_of_hits ? index > 0 : index < 0) {
        canvas_.fill(column - margin, row - margin, side, side, colour_of_index(index));
      }
    });
  }

  void paint_rings() {
    for (int radius = ring_m(); radius <= reach_m(); radius += ring_m()) {
      canvas_.circle(column(0), row(0), pixels(radius), kRing, 0.45);
    }
  }

  // Above everything that may be there.
  void label_rings() {
    const int scale = letter_scale();
    for (int radius = ring_m(); radius <= reach_m(); radius += ring_m()) {
      const std::string label = std::to_string(radius) + " m";
      const int width = Canvas::text_width(label, scale) - scale;
      if (const auto place = place_of_label(radius, (width / 2 + 2 * scale) / pixels(1))) {
        put_text(static_cast<int>(column(place->y_m)) - width / 2,
                 static_cast<int>(row(place->x_m)) - kGlyphHeight * scale / 2, label, kInk);
      }
    }
  }

  struct Place {
    double x_m = 0;
    double y_m = 0;
  };

  // Behind the car on its right, where the road seldom is, if the ring is in the picture there; as
  // near to the diagonal as the picture's border allows. None: nothing of the ring is in it.
  [[nodiscard]] std::optional<Place> place_of_label(double radius_m, double margin_m) const {
    const auto metres = [&](int cells) {
      return static_cast<double>(cells) / cells_per_metre_ - margin_m;
    };
    const double ahead_m = metres(x_.end - x_.origin);
    const double behind_m = metres(x_.origin - x_.first);
    const double left_m = metres(y_.end - y_.origin);
    const double right_m = metres(y_.origin - y_.first);
    const auto beside = [&](double way_m) {
      return std::sqrt(std::max(0.0, radius_m * radius_m - way_m * way_m));
    };
    for (const Place& most : {Place{-behind_m, -right_m}, Place{ahead_m, -right_m},
                              Place{-behind_m, left_m}, Place{ahead_m, left_m}}) {
      const double along_m =
          std::min(beside(std::min(radius_m * std::numbers::sqrt2 / 2, std::abs(most.y_m))),
                   std::abs(most.x_m));
      const double across_m = beside(along_m);
      constexpr double kRoundedM = 1e-6;
      if (across_m <= std::abs(most.y_m) + kRoundedM) {
        return Place{std::copysign(along_m, most.x_m), std::copysign(across_m, most.y_m)};
      }
    }
    return std::nullopt;
  }

  void paint_car(const CatalogueEntry& car) {
    const description::FootprintConfig& body = car.description->footprint;
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
    for (const description::SensorConfig& sensor : car.sensors) {
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
                 (kGlyphHeight + 2) * scale, kUnknown, 0.75);
    canvas_.text(column, row, words, colour, scale);
  }

  void paint_texts() {
    const int scale = letter_scale();
    const int line = (kGlyphHeight + 4) * scale;
    put_text(10, 10, words_of(title_of(*frame_)), kInk);
    put_text(10, 10 + line, words_of_sensors(frame_->header), kInk);
    put_text(10, 10 + 2 * line, std::to_string(frame_->header.points_used) + " points used", kInk);
    const int row = canvas_.height() - 10 - 3 * line;
    const bool is_enlarged = scale_ < kSmallestHit;
    const std::string side = std::to_string(kSmallestHit);
    paint_key("occupied" + (is_enlarged ? ", each cell " + side + " pixels wide" : ""), {2, 6, 10},
              row, scale);
    paint_key("free", {-7, -28, -56}, row + line, scale);
    paint_key("unknown", {0, 0, 0}, row + 2 * line, scale);
  }

  void paint_key(const std::string& words, std::initializer_list<int> indexes, int row, int scale) {
    const int side = kGlyphHeight * scale;
    int column = 10;
    canvas_.fill(column - 1, row - 1, 3 * side + 2, side + 2, kRing, 0.5);
    for (const int index : indexes) {
      canvas_.fill(column, row, side, side, colour_of_index(index));
      column += side;
    }
    put_text(column + 4 * scale, row, words, kInk);
  }

  // So far apart that their numbers do not cover each other.
  [[nodiscard]] int ring_m() const { return pixels(10) < 40 ? 20 : 10; }

  const GridFrame* frame_;
  int cells_per_metre_;
  Shown x_;
  Shown y_;
  int scale_;
  Canvas canvas_;
};

std::string name_of_sensor(const CatalogueEntry* car, unsigned number) {
  return car != nullptr && number < car->sensors.size() ? std::string(car->sensors[number].name)
                                                        : "sensor " + std::to_string(number);
}

}  // namespace

std::string words_of_sensors(const stream::Header& header) {
  const CatalogueEntry* const car = vehicle_of_id(header.vehicle_id);
  unsigned complete = 0;
  std::string others;
  for (unsigned i = 0; i < header.sensor_count; ++i) {
    if ((header.complete_sensors >> i & 1) != 0) {
      ++complete;
    } else {
      const bool is_partial = (header.partial_sensors >> i & 1) != 0;
      others += ", " + name_of_sensor(car, i) + (is_partial ? " partial" : " silent");
    }
  }
  return std::to_string(complete) + " of " + std::to_string(header.sensor_count) +
         " sensors complete" + others;
}

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
