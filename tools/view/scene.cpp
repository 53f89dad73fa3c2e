#include "tools/view/scene.hpp"

#include <algorithm>
#include <span>
#include <utility>

namespace iog::tools::view {
namespace {

constexpr std::uint32_t kHasFrame = 1;
constexpr std::uint32_t kIsKey = 2;
constexpr std::uint32_t kHasTruth = 4;
constexpr std::uint8_t kCellLayer = 0;
constexpr std::uint8_t kTruthLayer = 1;

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

// Everything but the tiles, whose end is the message's.
void append_points(std::string& message, const std::vector<SeenPoint>& points) {
  append(message, static_cast<std::uint32_t>(points.size()));
  for (const SeenPoint& point : points) {
    append(message, point.x_cm);
    append(message, point.y_cm);
    append(message, static_cast<std::uint8_t>(point.fate));
  }
}

}  // namespace

void Scene::on_news(std::function<void()> handler) {
  const std::lock_guard lock(mutex_);
  on_news_ = std::move(handler);
}

template <typename Cell>
void Scene::set_layer(Layer& layer, Cell&& cell) {
  std::array<std::byte, tile_coding::kTileBytes> cells{};
  std::array<std::byte, tile_coding::kTileBytes> payload{};
  for (std::size_t number = 0; number < layer.size(); ++number) {
    bool is_known = false;
    for (std::size_t i = 0; i < cells.size(); ++i) {
      cells[i] = cell(cell_of_tile(number, i));
      is_known = is_known || cells[i] != std::byte{0};
    }
    tile_coding::EncodedTile encoded{.encoding = tile_coding::Encoding::kRaw, .bytes = 0};
    if (is_known) {
      encoded = encoder_.encode_as(tile_coding::Encoding::kRunLength, cells, std::nullopt, payload);
    }
    const auto bytes = std::span(payload).first(encoded.bytes);
    Tile& tile = layer.at(number);
    if (!std::ranges::equal(bytes, tile.payload)) {
      tile = {.changed = update_,
              .encoding = encoded.encoding,
              .payload = std::vector(bytes.begin(), bytes.end())};
    }
  }
}

void Scene::publish_frame(const LiveGrid& grid, const Surroundings& surroundings,
                          std::string status) {
  std::function<void()> tell;
  {
    const std::lock_guard lock(mutex_);
    frame_update_ = ++update_;
    const auto cells = grid.cells();
    set_layer(cells_, [&](std::size_t cell) { return static_cast<std::byte>(cells[cell]); });
    has_truth_ = !surroundings.truth.empty();
    if (has_truth_) {
      set_layer(truth_, [&](std::size_t cell) {
        return surroundings.truth[cell] ? std::byte{1} : std::byte{0};
      });
    }
    for (std::size_t tile = 0; tile < ages_.size(); ++tile) {
      const auto age = grid.age_of(tile);
      ages_.at(tile) = age ? static_cast<std::uint8_t>(std::min<std::uint32_t>(*age, 254)) : 255;
    }
    points_ = surroundings.points;
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

void Scene::append_tiles(const Layer& layer, std::uint8_t number, const Place& place, bool is_key,
                         std::string& message) const {
  for (std::size_t i = 0; i < layer.size(); ++i) {
    const Tile& tile = layer.at(i);
    const bool is_needed = is_key ? !tile.payload.empty() : tile.changed > place.update;
    if (is_needed) {
      append(message, number);
      append(message, static_cast<std::uint8_t>(tile.encoding));
      append(message, static_cast<std::uint16_t>(i));
      append(message, static_cast<std::uint16_t>(tile.payload.size()));
      append_bytes(message, tile.payload);
    }
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
  const std::uint32_t flags =
      (has_frame ? kHasFrame : 0U) | (is_key ? kIsKey : 0U) | (has_truth_ ? kHasTruth : 0U);
  append(message, flags);
  append(message, static_cast<std::uint32_t>(words.size()));
  message += words;
  if (has_frame) {
    append_bytes(message, std::as_bytes(std::span(ages_)));
    append_points(message, points_);
    append_tiles(cells_, kCellLayer, place, is_key, message);
    if (has_truth_) {
      append_tiles(truth_, kTruthLayer, place, is_key, message);
    }
  }
  if (has_frame) {
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
