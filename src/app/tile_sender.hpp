// Converts the tiles of one grid to messages. Each tile is sent in its shortest encoding. This
// encoding may list just the changes since the tile's reference.
//
// Several cores encode waiting tiles and compute the contribution of each tile to the grid's CRC.
// Each tile is processed independently of the other tiles. The messages and the CRC are then
// generated in ascending order of tiles, so the bytes are the same for any number of cores. Tiles
// whose cells stay unchanged until the grid ends are all collected before they are encoded, and
// core 0 can do other work during encoding. Other tiles are copied and encoded in batches. A single
// core encodes each tile immediately, while the tile is still in the cache.
//
// Encoded class tiles are cached. The cells of a tile are read again only if the cells or the
// tile's reference have changed.
#pragma once

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <type_traits>
#include <utility>

#include "app/message_sender.hpp"
#include "geometry/grid.hpp"
#include "hal/cores.hpp"
#include "require/require.hpp"
#include "stream/class_hash.hpp"
#include "stream/class_window.hpp"
#include "stream/crc32.hpp"
#include "stream/message.hpp"
#include "stream/references.hpp"
#include "stream/tiles.hpp"
#include "tile_coding/encode.hpp"
#include "work/before_images.hpp"
#include "work/round.hpp"
#include "work/runs.hpp"

namespace iog::app {

// The encoding in which tiles are sent. Tiles in their shortest encoding are a tenth of the size of
// raw tiles, but take more instructions to encode.
enum class Coding : std::uint8_t { kShortest, kRaw };

// Specifies how long the cells of an added tile stay unchanged.
enum class CellsStay : std::uint8_t { kForTheCall, kToTheFinish };

// A TileSender contains sent and encoded tiles, so it must be in static memory. It uses 2.2 MB for
// classes. For indexes, it uses 2.4 MB because it also contains a batch of copied tiles. Hash is
// stream::GridHash for indexes and stream::ClassHash for classes.
template <Platform P, typename Hash>
class TileSender {
 public:
  struct Sent {
    std::uint32_t tiles = 0;
    std::uint32_t tiles_lost = 0;  // tiles in messages that the network did not accept
    std::uint32_t crc = 0;         // of the grid
  };

  // `platform` and `messages` must outlive this object.
  TileSender(P& platform, MessageSender<P>& messages, Coding coding,
             const geometry::Grid& grid = {})
      : platform_(&platform), messages_(&messages), coding_{coding}, grid_{grid} {}

  // Begins the occupancy grid or the class grid of a frame.
  void begin(const stream::Header& header) {
    begin_frame(header);
    hash_ = Hash(grid_);
    tiles_.begin_grid(header, stream::geometry_of(grid_));
    end_tile_ = grid_.tile_count();
  }
  void begin(const stream::Header& header, const stream::ClassWindow& window,
             window::Extent extent = {}) {
    begin_frame(header);
    hash_ = Hash({.a = window.corner_a, .b = window.corner_b});
    tiles_.begin_classes(header, window, grid_.cell_mm, extent);
    end_tile_ = extent.tile_count();
  }

  // Returns a place for the cells of the next tile. add() does not copy cells that are there.
  [[nodiscard]] tile_coding::MutableTileCells place() {
    if (coding_ == Coding::kRaw) {
      return tiles_.raw_place();
    }
    require(waiting_count_ < copies_.size());
    return copies_[waiting_count_].cells;
  }

  // Adds a tile. Tiles must be added in ascending order. A tile of indexes must have at least one
  // known cell.
  void add(std::size_t tile, tile_coding::TileCells cells, CellsStay cells_stay) {
    add({.tile = tile, .cells = cells}, cells_stay);
  }
  // Adds a tile of classes. `tile` is the tile's number in messages. The cells must not change
  // until finish(). The tile is skipped if no cell has a class. `age_frames` is the number of
  // frames since the tile's classes were computed. `version` must not be 0, and must differ from
  // the previous version if the cells have changed since the tile was last added.
  void add_classes(std::size_t tile, tile_coding::TileCells cells, std::uint8_t age_frames,
                   std::uint32_t version) {
    add({.tile = tile, .cells = cells, .age_frames = age_frames, .version = version},
        CellsStay::kToTheFinish);
  }

  // Returns true if added tiles wait until they are encoded together. Tiles wait if several cores
  // share the work and the tiles are not sent raw.
  [[nodiscard]] bool do_wait() const { return do_wait_; }

  // Encodes all waiting tiles. Core 0 runs do_beside() once, before or during encoding.
  template <typename DoBeside>
  void encode(DoBeside do_beside) {
    encode_waiting(waiting_count_, work::beside_of(do_beside));
  }

  // Encodes all waiting tiles in two rounds. Core 0 runs do_beside() once, before or during the
  // first round. During the second round, core 0 sends the tiles of the first one. The first round
  // is a little longer, because sending the indexes may take longer than half of the encoding.
  template <typename DoBeside>
  void encode_in_two(DoBeside do_beside) {
    encode_waiting(encoded_ + (waiting_count_ - encoded_) * 9 / 16, work::beside_of(do_beside));
    auto send_first = [this] { send_encoded(); };
    encode_waiting(waiting_count_, work::beside_of(send_first));
  }

  // Encodes any tiles that were added after encode().
  void encode_rest() {
    if (encoded_ < waiting_count_) {
      encode_waiting(waiting_count_, {});
    }
  }

  // Ends the grid. After this call, all tiles have been put into messages.
  Sent finish() {
    encode_rest();
    return finish_encoded();
  }
  // Like finish(), but all waiting tiles must already have been encoded. This function uses only
  // the calling core, so it may be called while other cores are busy.
  Sent finish_encoded() {
    send_waiting();
    send_tiles(end_tile_);
    sent_.crc = hash_.value();
    return sent_;
  }

 private:
  // Tiles whose cells may change are copied and encoded in rounds of kBatch tiles. `kBatch` is
  // large enough to keep the number of rounds low, and small enough to keep the data of a round in
  // the L2 cache.
  static constexpr std::size_t kBatch = 192;
  // The number of tiles that one core claims at a time.
  static constexpr work::Runs::Lengths kEncoded{.shortest = 4, .longest = 32};

  // True if encoded tiles are cached.
  static constexpr bool kIsKept = std::is_same_v<Hash, stream::ClassHash>;

  struct Added {
    std::size_t tile = 0;
    tile_coding::TileCells cells;
    std::uint8_t age_frames = 0;         // of classes
    std::uint32_t version = kNoVersion;  // of classes

    // Only tiles of classes can be blank.
    [[nodiscard]] bool is_left_out() const { return kIsKept && tile_coding::is_blank(cells); }
  };
  struct Copy {
    alignas(8) std::array<std::byte, tile_coding::kTileBytes> cells;
  };
  // An encoded tile, ready to be sent.
  struct Found {
    std::uint32_t version = kNoVersion;  // of the cells
    bool is_left_out = false;
    std::uint32_t remainder = 0;        // contribution of the cells to the grid's CRC
    std::uint32_t reference_frame = 0;  // frame of the cells' reference, or the cells' own frame if
                                        // there is no reference
    tile_coding::EncodedTile encoded{};
    alignas(8) std::array<std::byte, tile_coding::kTileBytes> payload{};
  };
  static constexpr std::uint32_t kNoVersion = 0;

  void add(const Added& added, CellsStay cells_stay) {
    if (coding_ == Coding::kRaw) {
      send_raw(added);
    } else if (!do_wait_) {
      encode_and_send(added);
    } else if (cells_stay == CellsStay::kToTheFinish) {
      waiting_[waiting_count_++] = added;
    } else {
      add_to_batch(added);
    }
  }

  void add_to_batch(const Added& added) {
    Copy& copy = copies_[waiting_count_];
    if (added.cells.data() != copy.cells.data()) {
      std::ranges::copy(added.cells, copy.cells.begin());
    }
    std::optional<Added>& waiting = waiting_[waiting_count_++];
    waiting = added;
    waiting->cells = copy.cells;
    if (waiting_count_ == copies_.size()) {
      encode_rest();
      send_waiting();
    }
  }

  void send_raw(const Added& added) {
    if (!added.is_left_out()) {
      const std::uint32_t remainder = stream::GridCrc32::remainder_of(added.cells);
      hash_.add_remainder(added.tile, remainder);
      append_or_send(added, stream::Encoding::kRaw, added.cells, remainder);
    }
  }

  void encode_and_send(const Added& added) {
    Found& found = found_[kIsKept ? added.tile : 0];  // a reused object stays in the cache
    encode(added, found, encoders_.front());
    send(added, found);
  }

  // A task reads no data that another task writes, or that core 0 writes when it sends other tiles.
  // Each task writes only to the slots of its own tiles and to the encoder of its core. While a
  // tile is being encoded into a slot, the slot's version is kNoVersion.
  void encode(const Added& added, Found& found, tile_coding::Encoder& encoder) const {
    const bool is_kept = kIsKept && found.version == added.version;
    if (is_kept && found.is_left_out) {
      return;
    }
    const auto reference = references_.usable(added.tile, frame_number_);
    if (is_kept && reference && reference->frame_number == found.reference_frame) {
      send_again(*reference, found);
      return;
    }
    found.version = kNoVersion;
    work::keep_order();
    found.is_left_out = added.is_left_out();
    if (!found.is_left_out) {
      found.remainder = stream::GridCrc32::remainder_of(added.cells);
      found.encoded = encoder.encode(added.cells, frame_number_, reference, found.payload);
      found.reference_frame = reference ? reference->frame_number : frame_number_;
    }
    work::keep_order();
    found.version = added.version;
  }

  // Updates the encoding of a tile whose cells have not changed. If the tile was last encoded in
  // self-contained form, that form is now its reference, and the new encoding states that no cell
  // has changed. Otherwise, the tile still has the same reference. If the function is interrupted
  // and repeated, the result is the same.
  void send_again(const tile_coding::Reference& reference, Found& found) const {
    found.payload[0] = static_cast<std::byte>(frame_number_ - reference.frame_number);
    if (stream::stands_by_itself(found.encoded.encoding)) {
      found.payload[1] = std::byte{0};
      found.encoded.bytes = 2;
      work::keep_order();
      found.encoded.encoding = stream::Encoding::kRunStartsSince;
    }
  }

  // Sends an encoded tile. Call this function for the tiles in ascending order.
  void send(const Added& added, const Found& found) {
    if (found.is_left_out) {
      return;
    }
    const auto [encoding, bytes] = found.encoded;
    hash_.add_remainder(added.tile, found.remainder);
    if (stream::stands_by_itself(encoding)) {
      references_.keep(added.tile, added.cells, frame_number_, bytes);
    } else {
      references_.note_changes(added.tile, bytes);
    }
    append_or_send(added, encoding, std::span(found.payload).first(bytes), found.remainder);
  }

  // Encodes the waiting tiles up to `end`.
  void encode_waiting(std::size_t end, work::Beside beside) {
    const std::size_t first = encoded_;
    const work::Runs runs(end - first, kEncoded);
    auto encode_run = [this, first, &runs](std::size_t item, std::size_t core) {
      const work::Run run = runs[item];
      for (std::size_t i = first + run.first; i < first + run.end; ++i) {
        encode(*waiting_[i], found_[waiting_[i]->tile], encoders_[core]);
      }
    };
    platform_->share(runs.count(), work::work_of(encode_run), beside);
    encoded_ = end;
  }

  void send_waiting() {
    require(encoded_ == waiting_count_);
    send_encoded();
    waiting_count_ = 0;
    encoded_ = 0;
    appended_ = 0;
  }
  // This function is not inlined because each message takes up a kilobyte on the stack.
  [[gnu::noinline]] void send_encoded() {
    for (; appended_ < encoded_; ++appended_) {
      const Added& added = *waiting_[appended_];
      send(added, found_[added.tile]);
    }
  }

  void begin_frame(const stream::Header& header) {
    frame_number_ = header.frame_number;
    sent_ = {};
    do_wait_ = coding_ != Coding::kRaw && platform_->cores() > 1;
  }

  [[nodiscard]] bool append(const Added& added, stream::Encoding encoding,
                            std::span<const std::byte> payload) {
    if constexpr (kIsKept) {
      return tiles_.append(added.tile, encoding, added.age_frames, payload);
    } else {
      return tiles_.append(added.tile, encoding, payload);
    }
  }

  // A raw payload consists of the cells themselves, so their CRC remainder is also used for the CRC
  // of the message.
  void append_or_send(const Added& added, stream::Encoding encoding,
                      std::span<const std::byte> payload, std::uint32_t remainder) {
    if (!append(added, encoding, payload)) {
      send_tiles(added.tile);
      require(append(added, encoding, payload));
    }
    tail_ = encoding == stream::Encoding::kRaw ? std::optional(remainder) : std::nullopt;
  }

  void send_tiles(std::size_t end_tile) {
    const std::uint32_t count = tiles_.tile_count();
    const bool is_sent =
        messages_->send(tiles_.finish(end_tile, messages_->sequence()), std::exchange(tail_, {}));
    (is_sent ? sent_.tiles : sent_.tiles_lost) += count;
  }

  P* platform_;
  MessageSender<P>* messages_;
  Coding coding_;
  geometry::Grid grid_;
  std::uint32_t frame_number_ = 0;
  Sent sent_;
  Hash hash_;
  stream::TilesWriter tiles_;
  std::size_t end_tile_ = geometry::kTileCount;
  protection::TailRemainder tail_;  // of the current message, if its last tile is raw
  bool do_wait_ = false;
  std::size_t waiting_count_ = 0;
  std::size_t encoded_ = 0;   // of the waiting tiles
  std::size_t appended_ = 0;  // of the encoded tiles, to messages
  std::array<std::optional<Added>, geometry::kTileCount> waiting_{};
  std::array<Copy, kIsKept ? 0 : kBatch> copies_{};            // of the first waiting tiles
  std::array<Found, geometry::kTileCount> found_{};            // by tile
  std::array<tile_coding::Encoder, hal::kMaxCores> encoders_;  // one per core
  stream::References references_;
};

}  // namespace iog::app
