// The tiles of one grid on their way into messages: each as short as it can be, also by what has
// changed since it was sent.
//
// Several cores encode a batch of them at a time and find what each adds to the grid's name, each
// tile by itself; in their order they become messages and the name. So the bytes are the same for
// any number of cores. One core alone encodes each tile at once, while it is in its cache.
#pragma once

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>

#include "app/message_sender.hpp"
#include "geometry/grid.hpp"
#include "hal/cores.hpp"
#include "require/require.hpp"
#include "stream/class_window.hpp"
#include "stream/crc32.hpp"
#include "stream/message.hpp"
#include "stream/references.hpp"
#include "stream/tiles.hpp"
#include "tile_coding/encode.hpp"
#include "work/round.hpp"
#include "work/runs.hpp"

namespace iog::app {

// How tiles are sent. Encoding them makes a tenth of the bytes of raw ones, and takes more
// instructions.
enum class Coding : std::uint8_t { kShortest, kRaw };

// Until when the cells of a tile stay as they were added.
enum class CellsStay : std::uint8_t { kForTheCall, kToTheFinish };

// Holds what was sent, and a batch, 1.4 MB: belongs into static memory. Hash: stream::GridHash of
// indexes, stream::ClassHash of classes.
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
  // was decided.
  void add_classes(std::size_t tile, tile_coding::TileCells cells, std::uint8_t age_frames) {
    add({.tile = tile, .cells = cells, .age_frames = age_frames}, CellsStay::kToTheFinish);
  }

  // Ends the grid: its messages have spoken of every tile.
  Sent finish() {
    encode_batch();
    send_tiles(geometry::kTileCount);
    sent_.crc = hash_.value();
    return sent_;
  }

 private:
  // A round of encoding: so many tiles that there are few rounds, and that what is read and written
  // of them stays in the second level cache.
  static constexpr std::size_t kBatch = 192;
  // Of them one core has so many together.
  static constexpr work::Runs::Lengths kEncoded{.shortest = 4, .longest = 32};

  struct Added {
    std::size_t tile = 0;
    tile_coding::TileCells cells;
    std::optional<std::uint8_t> age_frames{};

    // Only of classes it has to be asked.
    [[nodiscard]] bool is_left_out() const { return age_frames && tile_coding::is_blank(cells); }
  };
  // Where several cores find what is sent of a tile.
  struct Entry {
    std::optional<Added> added;
    bool is_left_out = false;
    std::uint32_t remainder = 0;  // what the cells add to the name
    tile_coding::EncodedTile encoded{};
    alignas(8) std::array<std::byte, tile_coding::kTileBytes> cells{};
    alignas(8) std::array<std::byte, tile_coding::kTileBytes> payload{};
  };

  void add(const Added& added, CellsStay cells_stay) {
    if (coding_ == Coding::kRaw || platform_->cores() == 1) {
      encode_batch();  // helpers may be lost while a batch fills
      if (!added.is_left_out()) {
        hash_.add(added.tile, added.cells);
        encode_and_send(added);
      }
      return;
    }
    Entry& entry = batch_[batched_++];
    entry.added = added;
    if (cells_stay == CellsStay::kForTheCall) {
      std::ranges::copy(added.cells, entry.cells.begin());
      entry.added->cells = entry.cells;
    }
    if (batched_ == kBatch) {
      encode_batch();
    }
  }

  void encode_and_send(const Added& added) {
    if (coding_ == Coding::kRaw) {
      append_or_send(added, stream::Encoding::kRaw, added.cells);
      return;
    }
    auto& payload = batch_.front().payload;
    send(added, encode(added, payload, encoders_.front()), payload);
  }

  // An item reads what no other writes, and writes its own entries and its core's encoder alone.
  tile_coding::EncodedTile encode(const Added& added, tile_coding::MutableTileCells payload,
                                  tile_coding::Encoder& encoder) const {
    return encoder.encode(added.cells, frame_number_, references_.usable(added.tile, frame_number_),
                          payload);
  }

  // Of a tile that is encoded: in the order of tiles.
  void send(const Added& added, tile_coding::EncodedTile encoded,
            std::span<const std::byte> payload) {
    const auto [encoding, bytes] = encoded;
    if (stream::stands_by_itself(encoding)) {
      references_.keep(added.tile, added.cells, frame_number_, bytes);
    } else {
      references_.note_changes(added.tile, bytes);
    }
    append_or_send(added, encoding, payload.first(bytes));
  }

  void encode_batch() {
    if (batched_ == 0) {
      return;
    }
    const work::Runs runs(batched_, kEncoded);
    auto encode_run = [this, &runs](std::size_t item, std::size_t core) {
      const work::Run run = runs[item];
      for (Entry& entry : std::span(batch_).subspan(run.first, run.end - run.first)) {
        entry.is_left_out = entry.added->is_left_out();
        if (!entry.is_left_out) {
          entry.remainder = stream::Crc32::remainder_of(entry.added->cells);
          entry.encoded = encode(*entry.added, entry.payload, encoders_[core]);
        }
      }
    };
    platform_->share(runs.count(), work::work_of(encode_run));
    for (const Entry& entry : std::span(batch_).first(batched_)) {
      if (!entry.is_left_out) {
        hash_.add_remainder(entry.added->tile, entry.remainder);
        send(*entry.added, entry.encoded, entry.payload);
      }
    }
    batched_ = 0;
  }

  void begin_frame(const stream::Header& header) {
    frame_number_ = header.frame_number;
    sent_ = {};
  }

  [[nodiscard]] bool append(const Added& added, stream::Encoding encoding,
                            std::span<const std::byte> payload) {
    return added.age_frames ? tiles_.append(added.tile, encoding, *added.age_frames, payload)
                            : tiles_.append(added.tile, encoding, payload);
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
  std::size_t batched_ = 0;
  std::array<Entry, kBatch> batch_{};
  std::array<tile_coding::Encoder, hal::kMaxCores> encoders_;  // one a core
  stream::References references_;
};

}  // namespace iog::app
