#include "tools/receive/serial/serial_link.hpp"

#include <algorithm>
#include <bit>
#include <vector>

#include "stream/references.hpp"
#include "tools/frames/tile_decoding.hpp"

namespace iog::tools {
namespace {

constexpr unsigned kLevels = std::countr_zero(geometry::kTilesPerSide) + 1;

struct Level {
  unsigned number;
  geometry::Grid grid;  // size of the memory; cell size and origin are the car's
};

// The level of this firmware's quadtree that the geometry is of.
std::optional<Level> level_of(const stream::Geometry& geometry) {
  for (unsigned level = 0; level < kLevels; ++level) {
    stream::Geometry cells = stream::geometry_of_level(0);
    cells.cell_mm = static_cast<std::uint16_t>(geometry.cell_mm >> level);
    cells.origin_x_mm = geometry.origin_x_mm;
    cells.origin_y_mm = geometry.origin_y_mm;
    const auto grid = stream::grid_of(cells);
    if (grid && geometry == stream::geometry_of_level(level, *grid)) {
      return Level{.number = level, .grid = *grid};
    }
  }
  return std::nullopt;
}

using Told = std::vector<std::optional<ToldTile>>;

// What the message says of the tiles that it speaks of; nothing of one that cannot be read.
Told told_by(const stream::Header& header, const stream::TilesHeader& tiles,
             stream::TileRecords records) {
  const ToldTile unknown{.frame_number = header.frame_number, .closed_us = header.closed_us};
  Told told(static_cast<std::size_t>(tiles.end_tile - tiles.first_tile), unknown);
  for (stream::TileRecord record; records.next(record);) {
    auto& tile = told.at(static_cast<std::size_t>(record.tile - tiles.first_tile));
    auto& cells = tile->cells.emplace();
    if (!stream::stands_by_itself(record.encoding) ||
        tile_coding::decode(record.encoding, record.payload, header.frame_number, std::nullopt,
                            cells) != tile_coding::DecodeStatus::kOk) {
      tile.reset();
    }
  }
  return told;
}

}  // namespace

void SerialLink::take(std::span<const std::byte> bytes) {
  counts_.bytes += bytes.size();
  for (const std::byte byte : bytes) {
    if (const auto message = decoder_.decode(byte)) {
      take_message(*message);
    }
  }
}

SerialCounts SerialLink::counts() const {
  SerialCounts counts = counts_;
  counts.damaged += decoder_.damaged();
  return counts;
}

// Bytes come in their order or not at all, so a wrong sequence is a gap, a receiver that joins, or
// a new run of the target; which of them, the numbers tell.
void SerialLink::take_message(std::span<const std::byte> message) {
  using protection::CheckStatus;
  using protection::SomeIpStatus;
  const protection::Received received = receiver_.receive(message);
  if (received.header == SomeIpStatus::kNotOurs) {
    ++counts_.not_ours;
  } else if (received.header == SomeIpStatus::kWrongVersion) {
    ++counts_.other_version;
    version_sent_ = received.interface_version;
  } else if (received.header != SomeIpStatus::kOk || received.check == CheckStatus::kError) {
    ++counts_.damaged;
  } else if (received.check == CheckStatus::kRepeated) {
    ++counts_.repeated;
  } else {
    take_content(received.content);
  }
}

void SerialLink::take_content(std::span<const std::byte> content) {
  stream::Header header;
  std::span<const std::byte> body;
  if (stream::read_header(content, header, body) != stream::ReadStatus::kOk) {
    ++counts_.malformed;
    return;
  }
  if (!follow(header)) {
    ++counts_.repeated;
    return;
  }
  if (header.type != stream::MessageType::kTiles) {
    ++counts_.not_understood;
    return;
  }
  take_tiles(header, body);
}

// Nothing comes late on a line, so another number is that of a new run. False: an old message.
bool SerialLink::follow(const stream::Header& header) {
  if (run_number_ != header.run_number) {
    counts_.restarts += run_number_ ? 1U : 0U;
    grid_.forget();
    run_number_ = header.run_number;
    expected_ = header.sequence;
  }
  const std::uint32_t ahead = header.sequence - expected_;
  if (ahead >= 1U << 31) {
    return false;
  }
  counts_.lost += ahead;
  expected_ = header.sequence + 1;
  return true;
}

void SerialLink::take_tiles(const stream::Header& header, std::span<const std::byte> body) {
  stream::TilesHeader tiles;
  stream::TileRecords records;
  if (stream::read_tiles(body, tiles, records) != stream::ReadStatus::kOk) {
    ++counts_.malformed;
    return;
  }
  const auto level = level_of(tiles.geometry);
  if (!level) {
    ++counts_.not_understood;
    return;
  }
  const Told told = told_by(header, tiles, records);
  ++counts_.messages;
  (level->number == 0 ? counts_.tiles : counts_.coarse_tiles) += tiles.tile_count;
  counts_.unreadable_tiles += static_cast<std::uint64_t>(
      std::ranges::count_if(told, [](const auto& tile) { return !tile; }));
  grid_.take(level->number, level->grid, tiles.first_tile, told, header);
  for (std::size_t i = 0; i < told.size() && level->number == 0 && on_tile_; ++i) {
    if (told[i]) {
      on_tile_(tiles.first_tile + i, *told[i]);
    }
  }
  if (on_message_) {
    on_message_();
  }
}

}  // namespace iog::tools
