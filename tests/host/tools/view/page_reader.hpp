// Reads the messages of a scene as the page does (page/messages.js), for the tests of tools/view.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>
#include <string>
#include <vector>

#include "geometry/grid.hpp"
#include "tools/frames/grid_frame.hpp"
#include "tools/frames/tile_decoding.hpp"
#include "tools/view/scene.hpp"

namespace iog::tools::view {

class PageReader {
 public:
  // Catches up with the scene; false if there is no news.
  bool catch_up(const Scene& scene) {
    const std::string message = scene.message_since(place_);
    if (message.empty()) {
      return false;
    }
    read(message);
    return true;
  }

  bool has_frame = false;  // of the last message
  bool is_key = false;
  bool has_truth = false;
  bool has_classes = false;
  bool has_true_classes = false;
  bool has_objects = false;
  std::size_t tile_records = 0;
  std::size_t points = 0;
  std::vector<stream::ObjectRecord> objects;  // but for the deviations of their places
  std::string words;
  std::vector<std::uint8_t> ages;
  std::vector<std::uint8_t> class_ages;
  std::vector<std::uint8_t> decided_ago;
  std::vector<std::int8_t> cells = std::vector<std::int8_t>(geometry::kCellCount, 0);
  std::vector<std::int8_t> truth = std::vector<std::int8_t>(geometry::kCellCount, 0);
  // By slot: cell_of_tile(slot, i).
  std::vector<std::int8_t> classes = std::vector<std::int8_t>(geometry::kCellCount, 0);
  std::vector<std::int8_t> true_classes = std::vector<std::int8_t>(geometry::kCellCount, 0);

 private:
  static std::uint32_t number(std::string_view bytes, std::size_t at, std::size_t count) {
    std::uint32_t value = 0;
    for (std::size_t i = count; i-- > 0;) {
      value = value << 8U | static_cast<std::uint8_t>(bytes.at(at + i));
    }
    return value;
  }

  void read(std::string_view bytes) {
    const std::uint32_t flags = number(bytes, 0, 4);
    has_frame = (flags & 1U) != 0;
    is_key = (flags & 2U) != 0;
    has_truth = (flags & 4U) != 0;
    has_classes = (flags & 8U) != 0;
    has_true_classes = (flags & 16U) != 0;
    has_objects = (flags & 32U) != 0;
    tile_records = 0;
    std::size_t at = 8 + number(bytes, 4, 4);
    words = bytes.substr(8, at - 8);
    if (!has_frame) {
      return;
    }
    if (is_key) {
      for (auto* const layer : {&cells, &truth, &classes, &true_classes}) {
        layer->assign(layer->size(), 0);
      }
    }
    at = read_ages(bytes, at, ages);
    if (has_classes) {
      at = read_ages(bytes, at, class_ages);
      at = read_ages(bytes, at, decided_ago);
    }
    points = number(bytes, at, 4);
    at += 4 + points * 5;
    at = has_objects ? read_objects(bytes, at) : at;
    while (at < bytes.size()) {
      at += read_tile(bytes, at);
      ++tile_records;
    }
  }

  std::size_t read_objects(std::string_view bytes, std::size_t at) {
    constexpr std::size_t kBytes = 36;
    objects.assign(number(bytes, at, 4), {});
    at += 4;
    for (stream::ObjectRecord& object : objects) {
      const auto u16 = [&](std::size_t field) {
        return static_cast<std::uint16_t>(number(bytes, at + field, 2));
      };
      object = {.id = number(bytes, at, 4),
                .state = static_cast<stream::ObjectState>(number(bytes, at + 4, 1)),
                .existence = static_cast<std::uint8_t>(number(bytes, at + 5, 1)),
                .age_frames = u16(30),
                .x_mm = static_cast<std::int32_t>(number(bytes, at + 6, 4)),
                .y_mm = static_cast<std::int32_t>(number(bytes, at + 10, 4)),
                .length_cm = u16(22),
                .width_cm = u16(24),
                .heading = u16(26),
                .flags = u16(28),
                .vx_cm_s = static_cast<std::int16_t>(u16(14)),
                .vy_cm_s = static_cast<std::int16_t>(u16(16)),
                .sigma_v_along_cm_s = u16(18),
                .sigma_v_across_cm_s = u16(20),
                .since_hit_ms = u16(32),
                .since_stopped_10ms = u16(34)};
      at += kBytes;
    }
    return at;
  }

  static std::size_t read_ages(std::string_view bytes, std::size_t at,
                               std::vector<std::uint8_t>& ages) {
    const std::string_view part = bytes.substr(at, geometry::kTileCount);
    ages.assign(part.begin(), part.end());
    return at + geometry::kTileCount;
  }

  std::size_t read_tile(std::string_view bytes, std::size_t at) {
    auto& layer = *std::array{&cells, &truth, &classes, &true_classes}.at(number(bytes, at, 1));
    const auto encoding = static_cast<tile_coding::Encoding>(number(bytes, at + 1, 1));
    const std::size_t tile = number(bytes, at + 2, 2);
    const std::size_t size = number(bytes, at + 4, 2);
    std::array<std::byte, tile_coding::kTileBytes> decoded{};
    if (size > 0) {
      const auto payload = std::as_bytes(std::span(bytes.substr(at + 6, size)));
      if (tile_coding::decode(encoding, payload, 0, std::nullopt, decoded) !=
          tile_coding::DecodeStatus::kOk) {
        malformed = true;
      }
    }
    for (std::size_t i = 0; i < decoded.size(); ++i) {
      layer.at(cell_of_tile(tile, i)) = static_cast<std::int8_t>(decoded.at(i));
    }
    return 6 + size;
  }

  Scene::Place place_;

 public:
  bool malformed = false;
};

}  // namespace iog::tools::view
