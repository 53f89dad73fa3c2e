// The tiles of one grid on their way into messages: each as short as it can be, also by what has
// changed since it was sent.
//
// Several cores encode a batch of them at a time, each tile by itself; in their order they become
// messages. So the bytes are the same for any number of cores. One core alone encodes each tile at
// once, while it is in its cache.
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

// Holds what was sent, and a batch, 1.4 MB: belongs into static memory.
template <Platform P>
class TileSender {
 public:
  struct Counts {
    std::uint32_t sent = 0;
    std::uint32_t lost = 0;  // the network took no message
  };

  // platform and messages outlive the sender.
  TileSender(P& platform, MessageSender<P>& messages, Coding coding)
      : platform_(&platform), messages_(&messages), coding_{coding} {}

  // Begins a frame's grid of occupancy indexes, or of classes.
  void begin(const stream::Header& header) {
    begin_frame(header);
    tiles_.begin_grid(header, stream::geometry_of_level(0));
  }
  void begin(const stream::Header& header, const stream::ClassWindow& window) {
    begin_frame(header);
    tiles_.begin_classes(header, window);
  }

  // Tiles come in rising order. age_frames: of classes, since the tile was decided.
  void add(std::size_t tile, tile_coding::TileCells cells,
           std::optional<std::uint8_t> age_frames = std::nullopt) {
    if (coding_ == Coding::kRaw) {
      append_or_send(tile, stream::Encoding::kRaw, age_frames, cells);
      return;
    }
    if (platform_->cores() == 1) {
      encode_batch();  // helpers may be lost while a batch fills
      Entry& entry = batch_.front();
      entry.tile = tile;
      entry.age_frames = age_frames;
      encode(entry, cells, encoders_.front());
      send(entry, cells);
      return;
    }
    Entry& entry = batch_[batched_++];
    entry.tile = tile;
    entry.age_frames = age_frames;
    std::ranges::copy(cells, entry.cells.begin());
    if (batched_ == kBatch) {
      encode_batch();
    }
  }

  // Ends the grid: its messages have spoken of every tile.
  Counts finish() {
    encode_batch();
    send_tiles(geometry::kTileCount);
    return counts_;
  }

 private:
  // A round of encoding: so many tiles that there are few rounds, and that what is read and written
  // of them stays in the second level cache.
  static constexpr std::size_t kBatch = 192;
  // Of them one core has so many together.
  static constexpr work::Runs::Lengths kEncoded{.shortest = 4, .longest = 32};

  struct Entry {
    std::size_t tile = 0;
    std::optional<std::uint8_t> age_frames{};
    tile_coding::EncodedTile encoded{};
    alignas(8) std::array<std::byte, tile_coding::kTileBytes> cells{};
    alignas(8) std::array<std::byte, tile_coding::kTileBytes> payload{};
  };

  // An item reads what no other writes, and writes its own entries and its core's encoder alone.
  void encode(Entry& entry, tile_coding::TileCells cells, tile_coding::Encoder& encoder) const {
    entry.encoded = encoder.encode(cells, frame_number_,
                                   references_.usable(entry.tile, frame_number_), entry.payload);
  }

  // Of a tile that is encoded: in the order of tiles.
  void send(const Entry& entry, tile_coding::TileCells cells) {
    const auto [encoding, bytes] = entry.encoded;
    if (stream::stands_by_itself(encoding)) {
      references_.keep(entry.tile, cells, frame_number_, bytes);
    } else {
      references_.note_changes(entry.tile, bytes);
    }
    append_or_send(entry.tile, encoding, entry.age_frames, std::span(entry.payload).first(bytes));
  }

  void encode_batch() {
    if (batched_ == 0) {
      return;
    }
    const work::Runs runs(batched_, kEncoded);
    auto encode_run = [this, &runs](std::size_t item, std::size_t core) {
      const work::Run run = runs[item];
      for (Entry& entry : std::span(batch_).subspan(run.first, run.end - run.first)) {
        encode(entry, entry.cells, encoders_[core]);
      }
    };
    platform_->share(runs.count(), work::work_of(encode_run));
    for (const Entry& entry : std::span(batch_).first(batched_)) {
      send(entry, entry.cells);
    }
    batched_ = 0;
  }

  void begin_frame(const stream::Header& header) {
    frame_number_ = header.frame_number;
    counts_ = {};
  }

  [[nodiscard]] bool append(std::size_t tile, stream::Encoding encoding,
                            std::optional<std::uint8_t> age_frames,
                            std::span<const std::byte> payload) {
    return age_frames ? tiles_.append(tile, encoding, *age_frames, payload)
                      : tiles_.append(tile, encoding, payload);
  }

  void append_or_send(std::size_t tile, stream::Encoding encoding,
                      std::optional<std::uint8_t> age_frames, std::span<const std::byte> payload) {
    if (append(tile, encoding, age_frames, payload)) {
      return;
    }
    send_tiles(tile);
    require(append(tile, encoding, age_frames, payload));
  }

  void send_tiles(std::size_t end_tile) {
    const std::uint32_t count = tiles_.tile_count();
    const bool is_sent = messages_->send(tiles_.finish(end_tile, messages_->sequence()));
    (is_sent ? counts_.sent : counts_.lost) += count;
  }

  P* platform_;
  MessageSender<P>* messages_;
  Coding coding_;
  std::uint32_t frame_number_ = 0;
  Counts counts_;
  stream::TilesWriter tiles_;
  std::size_t batched_ = 0;
  std::array<Entry, kBatch> batch_{};
  std::array<tile_coding::Encoder, hal::kMaxCores> encoders_;  // one a core
  stream::References references_;
};

}  // namespace iog::app
