#include "tools/formats/ros/object_messages.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <string_view>

#include "decision/decision.hpp"
#include "geometry/grid.hpp"
#include "numeric/elementary.hpp"
#include "tools/formats/picture/class_picture.hpp"
#include "tools/formats/ros/class_messages.hpp"
#include "tools/formats/ros/grid_parts.hpp"

namespace iog::tools::ros {
namespace {

using stream::ObjectRecord;
using stream::ObjectState;

constexpr double kHeightM = 1.5;
constexpr double kSmallestM = geometry::kCellMm / 1000.0;
constexpr double kShaftM = 0.2;     // of an arrow, across
constexpr double kHeadM = 0.6;      // along and across
constexpr double kWordsAboveM = 2;  // the ground
constexpr double kWordsPixels = 14;
constexpr double kLettersM = 0.8;  // where a reader knows no pixels
constexpr double kHit = 0.6;       // of light that it lets through, the rest
constexpr double kNotHit = 0.25;
constexpr std::uint8_t kMatchingId = 0;  // SceneEntityDeletion

struct Turn {
  double z = 0;  // of a quaternion about z
  double w = 1;
};

Turn turn_of(std::uint16_t heading) {
  const double half = heading * (numeric::kPi / 0x1p16);
  return {.z = numeric::sin(half), .w = numeric::cos(half)};
}

// To where (x, y), which is not zero, points.
Turn turn_to(double x, double y) {
  const double cos = x / std::sqrt(x * x + y * y);
  const double sin_half = std::sqrt(std::max(0.0, (1 - cos) / 2));
  return {.z = y < 0 ? -sin_half : sin_half, .w = std::sqrt(std::max(0.0, (1 + cos) / 2))};
}

// m/s, whichever way.
double speed_of(const ObjectRecord& object) {
  const double x = object.vx_cm_s / 100.0;
  const double y = object.vy_cm_s / 100.0;
  return std::sqrt(x * x + y * y);
}

decision::Class class_of(ObjectState state) {
  switch (state) {
    case ObjectState::kMoves:
      return decision::Class::kMoving;
    case ObjectState::kStopped:
      return decision::Class::kStopped;
    case ObjectState::kStands:
      return decision::Class::kStoppedOrUnmapped;
    default:
      return decision::Class::kOccupied;
  }
}

std::string_view name_of(ObjectState state) {
  switch (state) {
    case ObjectState::kMoves:
      return "moves";
    case ObjectState::kStopped:
      return "stopped";
    case ObjectState::kStands:
      return "stands";
    default:
      return "something";
  }
}

Colour colour_of(ObjectState state) {
  const int surest =
      static_cast<int>(class_of(state)) * stream::kSurenessCount + stream::kSurenessCount - 1;
  return colour_of_class(static_cast<std::int8_t>(surest));
}

// Of a second: a speed within two deviations of none is not believed.
bool has_way(const ObjectRecord& object) {
  return object.state == ObjectState::kMoves &&
         100 * speed_of(object) > 2.0 * object.sigma_v_along_cm_s;
}

double length_m(std::uint16_t length_cm) { return std::max(kSmallestM, length_cm / 100.0); }

class SceneWriter {
 public:
  explicit SceneWriter(const ObjectScene& scene) : scene_(&scene) {}

  std::vector<std::byte> write() {
    out_.put(static_cast<std::uint32_t>(scene_->gone.size()));
    for (const std::uint32_t id : scene_->gone) {
      put_stamp(out_, scene_->stamp_us);
      out_.put(kMatchingId);
      put_text(std::to_string(id));
    }
    out_.put(static_cast<std::uint32_t>(scene_->objects.size()));
    for (const ObjectRecord& object : scene_->objects) {
      put_entity(object);
    }
    return out_.take();
  }

 private:
  void put_text(const std::string& text) { out_.put(std::string_view(text)); }
  void put_none() { out_.put(std::uint32_t{0}); }
  void put_one() { out_.put(std::uint32_t{1}); }

  void put_entity(const ObjectRecord& object) {
    put_stamp(out_, scene_->stamp_us);
    out_.put(kLocalFrameId);
    put_text(std::to_string(object.id));
    put_stamp(out_, scene_->lifetime_us);
    out_.put(std::uint8_t{0});  // frame_locked
    put_metadata(object);
    put_arrow(object);
    put_cube(object);
    for (int other = 0; other < 4; ++other) {  // spheres, cylinders, lines, triangles
      put_none();
    }
    put_words(object);
    put_none();  // models
  }

  void put_metadata(const ObjectRecord& object) {
    const std::array pairs{
        std::pair<std::string_view, std::string>("class", name_of(object.state)),
        std::pair<std::string_view, std::string>("existence_percent",
                                                 std::to_string(object.existence * 100 / 255)),
        std::pair<std::string_view, std::string>("age_frames", std::to_string(object.age_frames)),
        std::pair<std::string_view, std::string>("since_hit_ms",
                                                 std::to_string(object.since_hit_ms))};
    out_.put(static_cast<std::uint32_t>(pairs.size()));
    for (const auto& [key, value] : pairs) {
      out_.put(key);
      put_text(value);
    }
  }

  void put_pose(const ObjectRecord& object, double z_m, Turn turn) {
    for (const double value :
         {object.x_mm / 1000.0, object.y_mm / 1000.0, z_m, 0.0, 0.0, turn.z, turn.w}) {
      out_.put(value);
    }
  }

  void put_colour(const ObjectRecord& object, double alpha) {
    const Colour colour = colour_of(object.state);
    for (const std::uint8_t part : {colour.red, colour.green, colour.blue}) {
      out_.put(part / 255.0);
    }
    out_.put(alpha);
  }

  void put_arrow(const ObjectRecord& object) {
    if (!has_way(object)) {
      put_none();
      return;
    }
    const double way_m = speed_of(object);
    const double head_m = std::min(kHeadM, way_m / 2);
    put_one();
    put_pose(object, kHeightM, turn_to(object.vx_cm_s, object.vy_cm_s));
    for (const double value : {way_m - head_m, kShaftM, head_m, kHeadM}) {
      out_.put(value);
    }
    put_colour(object, 1);
  }

  void put_cube(const ObjectRecord& object) {
    put_one();
    put_pose(object, kHeightM / 2, turn_of(object.heading));
    out_.put(length_m(object.length_cm));
    out_.put(length_m(object.width_cm));
    out_.put(kHeightM);
    put_colour(object, object.has(stream::kObjectNotHit) ? kNotHit : kHit);
  }

  void put_words(const ObjectRecord& object) {
    put_one();
    put_pose(object, kWordsAboveM, {});
    out_.put(std::uint8_t{1});  // billboard
    out_.put(kWordsPixels);
    out_.put(std::uint8_t{1});  // scale_invariant
    for (int part = 0; part < 4; ++part) {
      out_.put(1.0);
    }
    put_text(words_of(object));
  }

  const ObjectScene* scene_;
  CdrWriter out_;
};

// Who draws by markers has those of the frame before taken away first, so that nobody need know
// what is gone.
class MarkerWriter {
 public:
  explicit MarkerWriter(const ObjectScene& scene) : scene_(&scene) {}

  std::vector<std::byte> write() {
    const auto arrows = static_cast<std::size_t>(std::ranges::count_if(scene_->objects, has_way));
    out_.put(static_cast<std::uint32_t>(1 + 2 * scene_->objects.size() + arrows));
    put_head("", 0, Kind::kArrow, kDeleteAll);
    put_rest({}, {}, {}, {}, 0, {});
    for (const ObjectRecord& object : scene_->objects) {
      put_marks(object);
    }
    return out_.take();
  }

 private:
  enum class Kind : std::int32_t { kArrow = 0, kCube = 1, kText = 9 };
  static constexpr std::int32_t kAdd = 0;
  static constexpr std::int32_t kDeleteAll = 3;

  struct Size {
    double x = 0;
    double y = 0;
    double z = 0;
  };
  struct Spot {
    double x_m = 0;
    double y_m = 0;
    double z_m = 0;
  };

  void put_marks(const ObjectRecord& object) {
    const auto id = static_cast<std::int32_t>(object.id);
    const auto spot = [&](double z_m) {
      return Spot{object.x_mm / 1000.0, object.y_mm / 1000.0, z_m};
    };
    const Colour colour = colour_of(object.state);
    put_head("box", id, Kind::kCube, kAdd);
    put_rest(spot(kHeightM / 2), turn_of(object.heading),
             {length_m(object.length_cm), length_m(object.width_cm), kHeightM}, colour,
             object.has(stream::kObjectNotHit) ? kNotHit : kHit, {});
    if (has_way(object)) {
      put_head("way", id, Kind::kArrow, kAdd);
      put_rest(spot(kHeightM), turn_to(object.vx_cm_s, object.vy_cm_s),
               {speed_of(object), kShaftM, kHeadM}, colour, 1, {});
    }
    put_head("words", id, Kind::kText, kAdd);
    put_rest(spot(kWordsAboveM), {}, {0, 0, kLettersM}, {.red = 255, .green = 255, .blue = 255}, 1,
             words_of(object));
  }

  void put_head(std::string_view ns, std::int32_t id, Kind kind, std::int32_t action) {
    put_stamp(out_, scene_->stamp_us);
    out_.put(kLocalFrameId);
    out_.put(ns);
    out_.put(id);
    out_.put(static_cast<std::int32_t>(kind));
    out_.put(action);
  }

  void put_rest(const Spot& spot, Turn turn, const Size& size, Colour colour, double alpha,
                std::string_view text) {
    for (const double value :
         {spot.x_m, spot.y_m, spot.z_m, 0.0, 0.0, turn.z, turn.w, size.x, size.y, size.z}) {
      out_.put(value);
    }
    for (const std::uint8_t part : {colour.red, colour.green, colour.blue}) {
      out_.put(static_cast<float>(part) / 255);
    }
    out_.put(static_cast<float>(alpha));
    put_stamp(out_, scene_->lifetime_us);
    out_.put(std::uint8_t{0});  // frame_locked
    put_none();                 // points
    put_none();                 // colors
    out_.put(std::string_view());
    put_stamp(out_, scene_->stamp_us);  // of a texture, which there is not
    out_.put(std::string_view());
    out_.put(std::string_view());
    put_none();
    put_none();  // uv_coordinates
    out_.put(text);
    out_.put(std::string_view());  // a mesh, its file and what is in it
    out_.put(std::string_view());
    put_none();
    out_.put(std::uint8_t{0});
  }

  void put_none() { out_.put(std::uint32_t{0}); }

  const ObjectScene* scene_;
  CdrWriter out_;
};

}  // namespace

std::vector<std::byte> marker_array(const ObjectScene& scene) {
  return MarkerWriter(scene).write();
}

std::vector<std::byte> scene_update(const ObjectScene& scene) { return SceneWriter(scene).write(); }

std::string words_of(const ObjectRecord& object) {
  constexpr double kKmhOfCmS = 0.036;
  const std::string id = std::to_string(object.id) + ": ";
  switch (object.state) {
    case ObjectState::kMoves: {
      const long speed = std::lround(100 * speed_of(object) * kKmhOfCmS);
      const double twice = 2 * object.sigma_v_along_cm_s * kKmhOfCmS;
      if (!has_way(object)) {
        return id + "moves, speed not believed";
      }
      return id + std::to_string(speed) + " ± " + std::to_string(std::lround(std::ceil(twice))) +
             " km/h";
    }
    case ObjectState::kStopped:
      return id + "stopped";
    case ObjectState::kStands:
      return id + "stands";
    default:
      return id + "speed not believed";
  }
}

}  // namespace iog::tools::ros
