#include "tools/assembly/frame_assembler.hpp"

#include <algorithm>
#include <array>
#include <utility>

namespace iog::tools {
namespace {

// The only grid that this receiver can show.
bool is_understood(const stream::TileHeader& tile) {
  return tile.encoding == stream::Encoding::kRaw &&
         tile.storage == stream::Storage::kOccupancyIndex &&
         tile.side_log2 == stream::kTileSideLog2 && tile.grid_width == vehicle::kCellsPerSide &&
         tile.grid_height == vehicle::kCellsPerSide;
}

// Number i of a tile's cells, row by row, as a number of the grid's.
std::size_t cell_of_tile(std::size_t tile_x, std::size_t tile_y, std::size_t i) {
  const std::size_t y = tile_y * stream::kTileSide + i / stream::kTileSide;
  return y * grid::kStride + tile_x * stream::kTileSide + i % stream::kTileSide;
}

void paste(std::span<const std::byte> payload, const stream::TileHeader& tile, GridFrame& frame) {
  for (std::size_t i = 0; i < stream::kTileBytes; ++i) {
    frame.cells[cell_of_tile(tile.tile_x, tile.tile_y, i)] =
        static_cast<index::OccupancyIndex>(payload[i]);
  }
}

}  // namespace

std::uint32_t grid_crc_of(const GridFrame& frame) {
  stream::GridHash hash;
  for (std::size_t y = 0; y < stream::kTilesPerSide; ++y) {
    for (std::size_t x = 0; x < stream::kTilesPerSide; ++x) {
      if (frame.known_tiles.test(y * stream::kTilesPerSide + x)) {
        std::array<std::byte, stream::kTileBytes> tile{};
        for (std::size_t i = 0; i < stream::kTileBytes; ++i) {
          tile[i] = static_cast<std::byte>(frame.cells[cell_of_tile(x, y, i)]);
        }
        hash.add(x, y, tile);
      }
    }
  }
  return hash.value();
}

FrameAssembler::FrameAssembler(FrameHandler on_frame) : on_frame_(std::move(on_frame)) {}

void FrameAssembler::take(std::span<const std::byte> message) {
  stream::Header header;
  std::span<const std::byte> body;
  switch (stream::read_header(message, header, body)) {
    case stream::ReadStatus::kOk:
      break;
    case stream::ReadStatus::kNotOurs:
      ++counts_.not_ours;
      return;
    case stream::ReadStatus::kOtherVersion:
      ++counts_.other_version;
      return;
    case stream::ReadStatus::kTooShort:
    case stream::ReadStatus::kInconsistent:
      ++counts_.malformed;
      return;
  }
  if (is_restart(header)) {
    restart();
  }
  const SequenceWatch::Arrival arrival = sequences_.arrive(header.sequence);
  if (arrival == SequenceWatch::Arrival::kRepeated) {
    ++counts_.repeated;
    return;
  }
  ++counts_.messages;
  counts_.bytes += message.size();
  counts_.late += arrival == SequenceWatch::Arrival::kLate ? 1U : 0U;
  GridFrame* const frame = frame_of(header);
  if (frame == nullptr) {
    ++counts_.too_late;
    return;
  }
  if (header.type == stream::MessageType::kTile) {
    take_tile(*frame, header, body);
  } else if (header.type == stream::MessageType::kFrameEnd) {
    take_end(*frame, header, body);
  } else {
    ++counts_.not_understood;
  }
  // The oldest frame goes first; newer ones wait behind it, but not for ever.
  while (!waiting_.empty() &&
         (waiting_.begin()->second.is_whole() || waiting_.size() > kMaxWaiting)) {
    hand_over_first();
  }
}

void FrameAssembler::finish() {
  while (!waiting_.empty()) {
    hand_over_first();
  }
}

// Frame numbers and sequence both begin at 0 when the target starts.
bool FrameAssembler::is_restart(const stream::Header& header) const {
  const bool is_first = header.sequence == 0 && header.frame_number == 0;
  const bool has_run = counts_.messages > 0;
  return has_run && ((is_first && sequences_.expected() > kLateMessages) ||
                     header.frame_number + kRestartFrames < newest_frame_);
}

void FrameAssembler::restart() {
  finish();
  ++counts_.restarts;
  sequences_.restart();
  has_handed_over_ = false;
  newest_frame_ = 0;
}

GridFrame* FrameAssembler::frame_of(const stream::Header& header) {
  if (has_handed_over_ && header.frame_number < next_frame_) {
    return nullptr;
  }
  newest_frame_ = std::max(newest_frame_, header.frame_number);
  const auto [place, is_new] = waiting_.try_emplace(header.frame_number);
  if (is_new) {
    place->second.header = header;
  }
  return &place->second;
}

void FrameAssembler::take_tile(GridFrame& frame, const stream::Header& header,
                               std::span<const std::byte> body) {
  stream::TileHeader tile;
  std::span<const std::byte> payload;
  if (stream::read_tile(body, tile, payload) != stream::ReadStatus::kOk) {
    ++counts_.malformed;
    return;
  }
  if (!is_understood(tile)) {
    ++counts_.not_understood;
    return;
  }
  const std::size_t place = tile.tile_y * stream::kTilesPerSide + tile.tile_x;
  if (frame.known_tiles.test(place)) {
    ++counts_.repeated;
    return;
  }
  frame.known_tiles.set(place);
  ++frame.tiles;
  ++counts_.tiles;
  if (!frame.has_end) {
    frame.header = header;
  }
  paste(payload, tile, frame);
}

void FrameAssembler::take_end(GridFrame& frame, const stream::Header& header,
                              std::span<const std::byte> body) {
  stream::FrameEnd end;
  if (stream::read_frame_end(body, header.sensor_count, end) != stream::ReadStatus::kOk) {
    ++counts_.malformed;
    return;
  }
  frame.header = header;
  frame.end = end;
  frame.has_end = true;
}

void FrameAssembler::hand_over_first() {
  auto node = waiting_.extract(waiting_.begin());
  if (has_handed_over_) {
    frames_lost_ += node.key() - next_frame_;
  }
  has_handed_over_ = true;
  next_frame_ = node.key() + 1;
  GridFrame& frame = node.mapped();
  if (frame.header.has_evidence()) {
    frame.evidence_number = evidence_frames_++;
  }
  on_frame_(std::move(frame));
}

}  // namespace iog::tools
