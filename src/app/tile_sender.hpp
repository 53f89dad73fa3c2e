// The tiles of one grid on their way into messages: each as short as it can be, also by what has
// changed since it was sent.
//
// Several cores encode those that wait and find what each adds to the grid's CRC, each tile by
// itself; in their order they become messages and the CRC. So the bytes are the same for any
// number of cores. Tiles whose cells stay all wait, so that core 0 may do something else while they
// are encoded; others wait by the batch. One core alone encodes each tile at once, while it is in
// its cache.
//
// Of classes what was found of a tile is kept. As long as its cells stay as they were, and its
// reference does, they are not read again.
#pragma once

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <type_traits>

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

// How tiles are sent. Encoding them makes a tenth of the bytes of raw ones, and takes more
// instructions.
enum class Coding : std::uint8_t { kShortest, kRaw };

// Until when the cells of a tile stay as they were added.
enum class CellsStay : std::uint8_t { kForTheCall, kToTheFinish };

// Holds what was sent and what was found, and of indexes a batch, 2.2 or 2.4 MB: belongs into
// static memory. Hash: stream::GridHash of indexes, stream::ClassHash of classes.
template <Platform P, typename Hash>
class TileSender {
 public:
  struct Sent {
    std::uint32_t tiles = 0;
    std::uint32_t tiles_lost = 0;  // the network took no message
    std::uint32_t crc = 0;         // the grid's name
  };

  // platform and messages outlive the sender.
  TileSender(P& platform, MessageSender<P>& messages, Coding coding)
      : platform_(&platform), messages_(&messages), coding_{coding} {}

  // Begins a frame's grid of occupancy indexes, or of classes.
  void begin(const stream::Header& header) {
    begin_frame(header);
    hash_ = Hash();
    tiles_.begin_grid(header, stream::geometry_of_level(0));
  }
  void begin(const stream::Header& header, const stream::ClassWindow& window) {
    begin_frame(header);
    hash_ = Hash({.a = window.corner_a, .b = window.corner_b});
    tiles_.begin_classes(header, window);
  }

  // Tiles come in rising order. Of indexes: something is known in it.
  void add(std::size_t tile, tile_coding::TileCells cells, CellsStay cells_stay) {
    add({.tile = tile, .cells = cells}, cells_stay);
  }
  // Of classes, which stay to the finish; left out if no cell has one. age_frames: since the tile
  // was decided. version, not 0: another one if the cells are others than when it was added last.
  void add_classes(std::size_t tile, tile_coding::TileCells cells, std::uint8_t age_frames,
                   std::uint32_t version) {
    add({.tile = tile, .cells = cells, .age_frames = age_frames, .version = version},
        CellsStay::kToTheFinish);
  }

  // Whether the tiles of this grid wait, because several cores encode.
  [[nodiscard]] bool do_wait() const { return do_wait_; }

  // Encodes all that wait. do_beside() is done once, by core 0, beside them or before.
  template <typename DoBeside>
  void encode(DoBeside do_beside) {
    encode_waiting(work::beside_of(do_beside));
  }

  // What has been added since, if something has.
  void encode_rest() {
    if (encoded_ < waiting_count_) {
      encode_waiting({});
    }
  }

  // Ends the grid: its messages have spoken of every tile.
  Sent finish() {
    encode_rest();
    return finish_encoded();
  }
  // The same if all that wait are encoded: it has nothing for other cores, so it may be beside what
  // has.
  Sent finish_encoded() {
    send_waiting();
    send_tiles(geometry::kTileCount);
    sent_.crc = hash_.value();
    return sent_;
  }

 private:
  // Of tiles whose cells do not stay, copies are encoded in rounds of so many that there are few
  // rounds, and that what is read and written of them stays in the second level cache.
  static constexpr std::size_t kBatch = 192;
  // One core has so many tiles together.
  static constexpr work::Runs::Lengths kEncoded{.shortest = 4, .longest = 32};

  // Whether they are classes: what is found of a tile is kept.
  static constexpr bool kIsKept = std::is_same_v<Hash, stream::ClassHash>;

  struct Added {
    std::size_t tile = 0;
    tile_coding::TileCells cells;
    std::uint8_t age_frames = 0;         // of classes
    std::uint32_t version = kNoVersion;  // of classes

    // Only of classes it has to be asked.
    [[nodiscard]] bool is_left_out() const { return kIsKept && tile_coding::is_blank(cells); }
  };
  struct Copy {
    alignas(8) std::array<std::byte, tile_coding::kTileBytes> cells;
  };
  // What is sent of a tile.
  struct Found {
    std::uint32_t version = kNoVersion;  // of the cells
    bool is_left_out = false;
    std::uint32_t remainder = 0;        // what the cells add to the name
    std::uint32_t reference_frame = 0;  // of the cells' reference, their own frame without one
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
    std::ranges::copy(added.cells, copy.cells.begin());
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
      hash_.add(added.tile, added.cells);
      append_or_send(added, stream::Encoding::kRaw, added.cells);
    }
  }

  void encode_and_send(const Added& added) {
    Found& found = found_[kIsKept ? added.tile : 0];  // what is written again stays in the cache
    encode(added, found, encoders_.front());
    send(added, found);
  }

  // An item reads what no other writes, and writes its own tiles' places and its core's encoder
  // alone. A place that was left half written is of no version.
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
      found.remainder = stream::Crc32::remainder_of(added.cells);
      found.encoded = encoder.encode(added.cells, frame_number_, reference, found.payload);
      found.reference_frame = reference ? reference->frame_number : frame_number_;
    }
    work::keep_order();
    found.version = added.version;
  }

  // The same cells against the same reference, or against themselves: then nothing differs. Doing
  // it again from anywhere on ends the same.
  void send_again(const tile_coding::Reference& reference, Found& found) const {
    found.payload[0] = static_cast<std::byte>(frame_number_ - reference.frame_number);
    if (stream::stands_by_itself(found.encoded.encoding)) {
      found.payload[1] = std::byte{0};
      found.encoded.bytes = 2;
      work::keep_order();
      found.encoded.encoding = stream::Encoding::kRunStartsSince;
    }
  }

  // Of a tile that is encoded: in the order of tiles.
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
    append_or_send(added, encoding, std::span(found.payload).first(bytes));
  }

  void encode_waiting(work::Beside beside) {
    const std::size_t first = encoded_;
    const work::Runs runs(waiting_count_ - first, kEncoded);
    auto encode_run = [this, first, &runs](std::size_t item, std::size_t core) {
      const work::Run run = runs[item];
      for (std::size_t i = first + run.first; i < first + run.end; ++i) {
        encode(*waiting_[i], found_[waiting_[i]->tile], encoders_[core]);
      }
    };
    platform_->share(runs.count(), work::work_of(encode_run), beside);
    encoded_ = waiting_count_;
  }

  // Not inlined, because each message on its way takes a kilobyte of the stack.
  [[gnu::noinline]] void send_waiting() {
    require(encoded_ == waiting_count_);
    for (std::size_t i = 0; i < waiting_count_; ++i) {
      send(*waiting_[i], found_[waiting_[i]->tile]);
    }
    waiting_count_ = 0;
    encoded_ = 0;
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

  void append_or_send(const Added& added, stream::Encoding encoding,
                      std::span<const std::byte> payload) {
    if (append(added, encoding, payload)) {
      return;
    }
    send_tiles(added.tile);
    require(append(added, encoding, payload));
  }

  void send_tiles(std::size_t end_tile) {
    const std::uint32_t count = tiles_.tile_count();
    const bool is_sent = messages_->send(tiles_.finish(end_tile, messages_->sequence()));
    (is_sent ? sent_.tiles : sent_.tiles_lost) += count;
  }

  P* platform_;
  MessageSender<P>* messages_;
  Coding coding_;
  std::uint32_t frame_number_ = 0;
  Sent sent_;
  Hash hash_;
  stream::TilesWriter tiles_;
  bool do_wait_ = false;
  std::size_t waiting_count_ = 0;
  std::size_t encoded_ = 0;  // of them
  std::array<std::optional<Added>, geometry::kTileCount> waiting_{};
  std::array<Copy, kIsKept ? 0 : kBatch> copies_{};            // of the first that wait
  std::array<Found, geometry::kTileCount> found_{};            // by tile
  std::array<tile_coding::Encoder, hal::kMaxCores> encoders_;  // one a core
  stream::References references_;
};

}  // namespace iog::app
