// What can be seen at this moment, and what a page that has seen an earlier moment needs to catch
// up. One thread publishes; another one serves pages.
//
// A slow page gets the newest state next, and what lies between is skipped: nothing ever queues.
// page/messages.js reads the bytes of a message.
#pragma once

#include <array>
#include <atomic>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <memory>
#include <mutex>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "stream/objects.hpp"
#include "tile_coding/encode.hpp"
#include "tools/frames/live_classes.hpp"
#include "tools/frames/live_grid.hpp"
#include "tools/simulate/truth/cell_truth.hpp"
#include "tools/vehicles/seen_point.hpp"

namespace iog::tools::view {

// A simulated world at the end of a frame.
struct Truth {
  std::vector<bool> occupied;        // of each cell of the vehicle's grid
  CellArea area{};                   // of the world
  std::vector<TrueClass> classes{};  // of its cells, row by row from the lowest y; may be empty
};

// What comes with a frame if the sensors' packets, or the simulated world, are at hand.
struct Surroundings {
  std::vector<SeenPoint> points;
  std::shared_ptr<const Truth> truth;  // null: not known
};

class Scene {
 public:
  // What a page has seen. A new page begins with the default.
  struct Place {
    std::uint64_t update = 0;
    std::uint32_t frames_to_key = 0;
  };

  // Called after each publication, by the thread that publishes.
  void on_news(std::function<void()> handler);

  // A new frame: the grid and the classes as they are now, with the ages of their tiles. objects:
  // null if nothing is known of them.
  void publish_frame(const LiveGrid& grid, const LiveClasses& classes,
                     const Surroundings& surroundings, std::string status,
                     const stream::ObjectList* objects = nullptr);
  // Only the words have changed.
  void publish_status(std::string status);
  // The map block of this PC, of which pages draw outlines; before pages are served.
  void set_map(std::vector<std::uint8_t> block) { map_ = std::move(block); }
  [[nodiscard]] const std::vector<std::uint8_t>& map() const { return map_; }  // empty: none
  // The vehicle as JSON. It goes into each message that is whole in itself.
  void set_vehicle(std::string vehicle);

  // The message that brings a page from its place to now; it moves the place. Empty if the page is
  // there already. Every 25th message with a frame is a key, whole in itself. So a page can go back
  // to any frame by reading at most 25 messages.
  [[nodiscard]] std::string message_since(Place& place) const;

  // A page has opened. From now on the scene counts as watched.
  void note_page() { is_watched_ = true; }
  [[nodiscard]] bool is_watched() const { return is_watched_; }

  // What pages ask for, in words. The oldest requests are forgotten if nobody takes them.
  void ask(std::string_view request);
  [[nodiscard]] std::vector<std::string> take_requests();

 private:
  static constexpr std::uint32_t kFramesPerKey = 25;
  static constexpr std::size_t kMaxRequests = 16;

  struct Tile {
    std::uint64_t changed = 0;  // the update in which it became what it is
    tile_coding::Encoding encoding = tile_coding::Encoding::kRaw;
    std::vector<std::byte> payload;  // empty: 0 in all cells
  };
  struct Layer {
    bool is_known = false;
    bool was_known = false;  // in the frame before
    std::array<Tile, geometry::kTileCount> tiles{};
  };
  // As they are numbered in messages. Tiles of the last two are by slot (window::slot_of).
  enum class LayerName : std::uint8_t { kIndexes, kOccupied, kClasses, kTrueClasses };
  static constexpr std::size_t kLayerCount = 4;
  using Ages = std::array<std::uint8_t, geometry::kTileCount>;  // frames, 255: never came

  using Cells = std::array<std::byte, tile_coding::kTileBytes>;

  // copy(tile, cells): writes the cells of that tile.
  template <typename Copy>
  void set_layer(LayerName name, Copy&& copy);
  void set_index_layers(const LiveGrid& grid, const Surroundings& surroundings);
  void set_class_layers(const LiveClasses& classes, const Surroundings& surroundings);
  [[nodiscard]] bool is_known(LayerName name) const {
    return layers_.at(static_cast<std::size_t>(name)).is_known;
  }
  void append_tiles(LayerName name, const Place& place, bool is_key, std::string& message) const;
  void append_frame(const Place& place, bool is_key, std::string& message) const;

  std::atomic<bool> is_watched_ = false;
  std::function<void()> on_news_;
  mutable std::mutex mutex_;
  std::uint64_t update_ = 0;
  std::uint64_t frame_update_ = 0;  // the last one with a frame
  std::array<Layer, kLayerCount> layers_{};
  Ages ages_{};         // of index tiles, since they came
  Ages class_ages_{};   // of class tiles, since they came
  Ages decided_ago_{};  // and since they were decided
  std::vector<SeenPoint> points_;
  std::optional<std::vector<stream::ObjectRecord>> objects_;
  std::string status_ = "{}";
  std::string vehicle_ = "null";
  std::vector<std::uint8_t> map_;
  std::vector<std::string> requests_;
  tile_coding::Encoder encoder_;
};

}  // namespace iog::tools::view
