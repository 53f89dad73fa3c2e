// What can be seen at this moment, and what a page that has seen an earlier moment needs to catch
// up. One thread publishes; another one serves pages.
//
// A slow page gets the newest state next, and what lies between is skipped: nothing ever queues.
// The bytes of a message are in docs/view.md.
#pragma once

#include <array>
#include <atomic>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <mutex>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "tile_coding/encode.hpp"
#include "tools/receive/live_grid.hpp"
#include "tools/view/scan_points.hpp"

namespace iog::tools::view {

// What comes with a frame if the sensors' packets, or the simulated world, are at hand.
struct Surroundings {
  std::vector<SeenPoint> points;
  std::vector<bool> truth;  // of each cell, whether it is occupied in truth; empty: not known
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

  // A new frame: the grid as it is now, with the ages of its tiles.
  void publish_frame(const LiveGrid& grid, const Surroundings& surroundings, std::string status);
  // Only the words have changed.
  void publish_status(std::string status);
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
  using Layer = std::array<Tile, geometry::kTileCount>;

  // cell(number): its value.
  template <typename Cell>
  void set_layer(Layer& layer, Cell&& cell);
  void append_tiles(const Layer& layer, std::uint8_t number, const Place& place, bool is_key,
                    std::string& message) const;

  std::atomic<bool> is_watched_ = false;
  std::function<void()> on_news_;
  mutable std::mutex mutex_;
  std::uint64_t update_ = 0;
  std::uint64_t frame_update_ = 0;  // the last one with a frame
  Layer cells_;
  Layer truth_;
  bool has_truth_ = false;
  std::array<std::uint8_t, geometry::kTileCount> ages_{};  // frames, 254: or more, 255: never came
  std::vector<SeenPoint> points_;
  std::string status_ = "{}";
  std::string vehicle_ = "null";
  std::vector<std::string> requests_;
  tile_coding::Encoder encoder_;
};

}  // namespace iog::tools::view
