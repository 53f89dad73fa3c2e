#include "tools/view/scene.hpp"

#include <algorithm>
#include <cstring>
#include <span>

namespace iog::tools::view {
namespace {

constexpr std::uint32_t kHasFrame = 1;
constexpr std::uint32_t kIsKey = 2;
constexpr std::uint32_t kHasTruth = 4;
constexpr std::uint32_t kHasClasses = 8;
constexpr std::uint32_t kHasTrueClasses = 16;
constexpr std::uint32_t kHasObjects = 32;
constexpr std::uint8_t kNever = 255;
constexpr std::size_t kRow = geometry::kTileSide;
constexpr std::int64_t kSide = kRow;
static_assert(sizeof(TrueClass) == 1 && sizeof(index::OccupancyIndex) == 1);

// Little endian, as every browser's typed arrays are.
template <typename Number>
void append(std::string& message, Number number) {
  for (std::size_t i = 0; i < sizeof number; ++i) {
    message += static_cast<char>(static_cast<std::uint64_t>(number) >> (8 * i) & 0xFFU);
  }
}

void append_bytes(std::string& message, std::span<const std::byte> bytes) {
  for (const std::byte byte : bytes) {
    message += static_cast<char>(byte);
  }
}

void append_points(std::string& message, const std::vector<SeenPoint>& points) {
  append(message, static_cast<std::uint32_t>(points.size()));
  for (const SeenPoint& point : points) {
    append(message, point.x_cm);
    append(message, point.y_cm);
    append(message, static_cast<std::uint8_t>(point.fate));
  }
}

void append_objects(std::string& message, const std::vector<stream::ObjectRecord>& objects) {
  append(message, static_cast<std::uint32_t>(objects.size()));
  for (const stream::ObjectRecord& object : objects) {
    append(message, object.id);
    append(message, static_cast<std::uint8_t>(object.state));
    append(message, object.existence);
    for (const std::int32_t place_mm : {object.x_mm, object.y_mm}) {
      append(message, place_mm);
    }
    for (const std::int16_t velocity : {object.vx_cm_s, object.vy_cm_s}) {
      append(message, velocity);
    }
    for (const std::uint16_t number :
         {object.sigma_v_along_cm_s, object.sigma_v_across_cm_s, object.length_cm, object.width_cm,
          object.heading, object.flags, object.age_frames, object.since_hit_ms,
          object.since_stopped_10ms}) {
      append(message, number);
    }
  }
}

std::uint8_t byte_of_age(std::optional<std::uint32_t> age_frames) {
  return age_frames ? static_cast<std::uint8_t>(std::min<std::uint32_t>(*age_frames, kNever - 1))
                    : kNever;
}

// What the truth says of a row of a tile, from cell (x, y) of the world on. What it does not know
// stays as it is.
void copy_true_row(const Truth& truth, std::int64_t x, std::int64_t y,
                   std::span<std::byte, kRow> row) {
  const std::int64_t width = truth.area.width;
  const std::int64_t right = x - truth.area.x;
  const std::int64_t up = y - truth.area.y;
  const std::int64_t first = std::max<std::int64_t>(0, -right);
  const std::int64_t end = std::min(kSide, width - right);
  if (up >= 0 && up < truth.area.height && first < end) {
    std::memcpy(&row[static_cast<std::size_t>(first)],
                &truth.classes[static_cast<std::size_t>(up * width + right + first)],
                static_cast<std::size_t>(end - first));
  }
}

}  // namespace

void Scene::on_news(std::function<void()> handler) {
  const std::lock_guard lock(mutex_);
  on_news_ = std::move(handler);
}

template <typename Copy>
void Scene::set_layer(LayerName name, Copy&& copy) {
  Layer& layer = layers_.at(static_cast<std::size_t>(name));
  layer.is_known = true;
  Cells cells{};
  Cells payload{};
  for (std::size_t number = 0; number < layer.tiles.size(); ++number) {
    copy(number, cells);
    tile_coding::EncodedTile encoded{.encoding = tile_coding::Encoding::kRaw, .bytes = 0};
    if (cells != Cells{}) {
      encoded = encoder_.encode(cells, 0, std::nullopt, payload);
    }
    const auto bytes = std::span(payload).first(encoded.bytes);
    Tile& tile = layer.tiles.at(number);
    // A page may have read a key in which the layer was not.
    if (!layer.was_known || !std::ranges::equal(bytes, tile.payload)) {
      tile = {.changed = update_,
              .encoding = encoded.encoding,
              .payload = std::vector(bytes.begin(), bytes.end())};
    }
  }
}

void Scene::set_index_layers(const LiveGrid& grid, const Surroundings& surroundings) {
  const geometry::Grid& shape = grid.shape();
  set_layer(LayerName::kIndexes, [&](std::size_t tile, Cells& to) {
    to = tile < shape.tile_count() ? cells_of_tile(grid.cells(), tile, shape) : Cells{};
  });
  const Truth* const truth = surroundings.truth.get();
  if (truth != nullptr) {
    set_layer(LayerName::kOccupied, [&](std::size_t tile, Cells& to) {
      for (std::size_t i = 0; i < to.size(); ++i) {
        to[i] = static_cast<std::byte>(tile < shape.tile_count() &&
                                       truth->occupied[cell_of_tile(tile, i, shape)]);
      }
    });
  }
  for (std::size_t tile = 0; tile < ages_.size(); ++tile) {
    ages_.at(tile) = byte_of_age(grid.age_of(tile));
  }
}

void Scene::set_class_layers(const LiveClasses& classes, const Surroundings& surroundings) {
  if (!classes.window()) {
    return;
  }
  set_layer(LayerName::kClasses, [&](std::size_t slot, Cells& to) {
    std::memcpy(to.data(), classes.tile(slot).data(), to.size());
  });
  const Truth* const truth = surroundings.truth.get();
  if (truth != nullptr && !truth->classes.empty()) {
    set_layer(LayerName::kTrueClasses, [&](std::size_t slot, Cells& to) {
      to.fill(std::byte{0});
      const window::TileNumber tile = stream::area_of(*classes.window()).tile_at(slot);
      for (std::size_t i = 0; i < to.size(); i += kRow) {
        copy_true_row(*truth, tile.a * kSide, tile.b * kSide + static_cast<std::int64_t>(i / kRow),
                      std::span(to).subspan(i).first<kRow>());
      }
    });
  }
  for (std::size_t slot = 0; slot < class_ages_.size(); ++slot) {
    class_ages_.at(slot) = byte_of_age(classes.age_of(slot));
    decided_ago_.at(slot) = classes.decided_ago(slot).value_or(kNever);
  }
}

void Scene::publish_frame(const LiveGrid& grid, const LiveClasses& classes,
                          const Surroundings& surroundings, std::string status,
                          const stream::ObjectList* objects) {
  std::function<void()> tell;
  {
    const std::lock_guard lock(mutex_);
    frame_update_ = ++update_;
    for (Layer& layer : layers_) {
      layer.was_known = std::exchange(layer.is_known, false);
    }
    set_index_layers(grid, surroundings);
    set_class_layers(classes, surroundings);
    points_ = surroundings.points;
    objects_.reset();
    if (objects != nullptr) {
      objects_.emplace(objects->all().begin(), objects->all().end());
    }
    status_ = std::move(status);
    tell = on_news_;
  }
  if (tell) {
    tell();
  }
}

void Scene::publish_status(std::string status) {
  std::function<void()> tell;
  {
    const std::lock_guard lock(mutex_);
    ++update_;
    status_ = std::move(status);
    tell = on_news_;
  }
  if (tell) {
    tell();
  }
}

void Scene::set_vehicle(std::string vehicle) {
  const std::lock_guard lock(mutex_);
  vehicle_ = std::move(vehicle);
}

void Scene::append_tiles(LayerName name, const Place& place, bool is_key,
                         std::string& message) const {
  if (!is_known(name)) {
    return;
  }
  const auto& tiles = layers_.at(static_cast<std::size_t>(name)).tiles;
  for (std::size_t i = 0; i < tiles.size(); ++i) {
    const Tile& tile = tiles.at(i);
    const bool is_needed = is_key ? !tile.payload.empty() : tile.changed > place.update;
    if (is_needed) {
      append(message, static_cast<std::uint8_t>(name));
      append(message, static_cast<std::uint8_t>(tile.encoding));
      append(message, static_cast<std::uint16_t>(i));
      append(message, static_cast<std::uint16_t>(tile.payload.size()));
      append_bytes(message, tile.payload);
    }
  }
}

void Scene::append_frame(const Place& place, bool is_key, std::string& message) const {
  append_bytes(message, std::as_bytes(std::span(ages_)));
  if (is_known(LayerName::kClasses)) {
    append_bytes(message, std::as_bytes(std::span(class_ages_)));
    append_bytes(message, std::as_bytes(std::span(decided_ago_)));
  }
  append_points(message, points_);
  if (objects_) {
    append_objects(message, *objects_);
  }
  for (std::size_t layer = 0; layer < kLayerCount; ++layer) {
    append_tiles(static_cast<LayerName>(layer), place, is_key, message);
  }
}

std::string Scene::message_since(Place& place) const {
  const std::lock_guard lock(mutex_);
  if (place.update == update_) {
    return {};
  }
  const bool has_frame = frame_update_ > place.update;
  const bool is_key = has_frame && place.frames_to_key == 0;
  const std::string words =
      R"({"status":)" + status_ + (is_key ? R"(,"vehicle":)" + vehicle_ : "") + "}";
  std::string message;
  const std::uint32_t flags = (has_frame ? kHasFrame : 0U) | (is_key ? kIsKey : 0U) |
                              (is_known(LayerName::kOccupied) ? kHasTruth : 0U) |
                              (is_known(LayerName::kClasses) ? kHasClasses : 0U) |
                              (is_known(LayerName::kTrueClasses) ? kHasTrueClasses : 0U) |
                              (objects_ ? kHasObjects : 0U);
  append(message, flags);
  append(message, static_cast<std::uint32_t>(words.size()));
  message += words;
  if (has_frame) {
    append_frame(place, is_key, message);
    place.frames_to_key = (is_key ? kFramesPerKey : place.frames_to_key) - 1;
  }
  place.update = update_;
  return message;
}

void Scene::ask(std::string_view request) {
  const std::lock_guard lock(mutex_);
  if (requests_.size() == kMaxRequests) {
    requests_.erase(requests_.begin());
  }
  requests_.emplace_back(request);
}

std::vector<std::string> Scene::take_requests() {
  const std::lock_guard lock(mutex_);
  return std::exchange(requests_, {});
}

}  // namespace iog::tools::view
