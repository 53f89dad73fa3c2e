// A target that sends classes of a made-up world, and objects: what docs/spec.md 3.9, 3.10 and 3.12
// say, written once more, for the tests of receivers.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <map>
#include <memory>
#include <optional>
#include <span>
#include <utility>
#include <vector>

#include "fakes/random.hpp"
#include "protection/protected_message.hpp"
#include "stream/channel.hpp"
#include "stream/class_window.hpp"
#include "stream/grid_hash.hpp"
#include "stream/message.hpp"
#include "stream/objects.hpp"
#include "stream/references.hpp"
#include "stream/tiles.hpp"
#include "tile_coding/encode.hpp"

namespace iog::tools {

struct FakeClassWorld {
  using Cells = std::array<std::byte, tile_coding::kTileBytes>;

  std::uint64_t seed = 1;
  window::Extent extent{};

  // What is in tile (a, b) of the world in a frame. Two of three tiles are unknown; in the others
  // most cells stay from frame to frame.
  [[nodiscard]] std::optional<Cells> at(std::int32_t a, std::int32_t b, std::uint32_t frame) const;

  // The tile of lowest x and y of the window: it moves across the world's origin.
  [[nodiscard]] static std::pair<std::int32_t, std::int32_t> corner_in(std::uint32_t frame) {
    const auto moved = static_cast<std::int32_t>(frame);
    return {-34 + moved / 2, 3 - moved / 3};
  }

  // A place in the world, its slot in memory and its number in messages.
  struct Place {
    std::int32_t a;
    std::int32_t b;
    std::size_t slot;
    std::size_t number;
  };
  // All of the window, row by row from its corner.
  [[nodiscard]] std::vector<Place> window_in(std::uint32_t frame) const;

  static std::byte class_byte(tests::Random& random) {
    return static_cast<std::byte>(8 + random.below(64));
  }

  // What of it is known in the window, by the tiles' numbers in messages.
  [[nodiscard]] std::map<std::size_t, Cells> tiles_in(std::uint32_t frame) const;

  [[nodiscard]] std::uint32_t name_of(std::uint32_t frame) const;

  // How old the decisions of a tile are.
  [[nodiscard]] static std::uint8_t age_of(std::size_t number, std::uint32_t frame) {
    return static_cast<std::uint8_t>((number + frame) % 8);
  }
};

class FakeClassTarget {
 public:
  using Messages = std::vector<std::vector<std::byte>>;

  FakeClassTarget(FakeClassWorld world, std::uint32_t run_number, bool has_indexes = true)
      : world_(world), run_number_(run_number), has_indexes_(has_indexes) {}

  // From the next frame on it says where so many objects are, at most stream::kMaxObjects.
  void look_for_objects(std::uint16_t count) { objects_ = count; }
  [[nodiscard]] static stream::ObjectList objects_in(std::uint32_t frame, std::uint16_t count);

  // The messages of the next frame. causes: bits of ClassWindow::causes.
  [[nodiscard]] Messages next(std::uint16_t causes = 0);

  // Those of so many frames, in one.
  [[nodiscard]] Messages frames(std::uint32_t count);

  // One tile in 50 of occupancy indexes is known.
  static constexpr std::size_t kKnownIndexTiles = 21;

  static FakeClassWorld::Cells index_tile(std::size_t tile, std::uint32_t frame);

 private:
  [[nodiscard]] stream::ClassWindow window_of_frame(std::uint16_t causes) const;

  void send(std::span<std::byte> message);

  template <typename Append>
  void append_or_send(std::size_t tile, const Append& append);

  void send_indexes();
  void send_classes();
  void send_class_end();
  void send_objects();
  void send_frame_end();

  template <typename Write>
  void send_end(stream::MessageType type, const Write& write);

  FakeClassWorld world_;
  std::uint32_t run_number_;
  bool has_indexes_;
  std::optional<std::uint16_t> objects_;
  std::uint32_t frame_ = 0;
  std::uint32_t sent_ = 0;
  stream::Header header_;
  stream::ClassWindow window_;
  stream::GridHash hash_;
  stream::TilesWriter writer_;
  protection::Sender sender_{stream::kNetworkChannel};
  std::unique_ptr<stream::References> references_ = std::make_unique<stream::References>();
  std::unique_ptr<tile_coding::Encoder> encoder_ = std::make_unique<tile_coding::Encoder>();
  Messages messages_;
};

}  // namespace iog::tools
