#include "serial/grid_sender.hpp"

#include "require/require.hpp"

namespace iog::serial {

static_assert(sizeof(GridSender) < 66'000);

namespace {

constexpr std::array<unsigned, 3> kLevels{CoarseLevels::kRoughLevel, CoarseLevels::kFineLevel, 0};
constexpr std::array<std::size_t, 3> kTileCounts{1, CoarseLevels::kFineTileCount,
                                                 geometry::kTileCount};

}  // namespace

// A message composed from the previous frame is still true of that frame, so it is sent unchanged.
GridSender::GridSender() = default;

void GridSender::begin_frame(const stream::Header& header) {
  if (is_composing_) {
    finish_message(tile_);
  }
  header_ = header;
  coarse_.clear();
  window_.begin(rounds_[kCells].next);
}

void GridSender::take_tile(std::size_t tile, tile_coding::TileCells cells) {
  if (fits_) {
    const auto [x, y] = rows_.place_of(tile);
    const auto number =
        static_cast<std::size_t>(y) * geometry::kTilesPerSide + static_cast<std::size_t>(x);
    coarse_.add_tile(number, cells);
    window_.add_tile(number, cells);
  }
}

void GridSender::end_frame() {
  const bool has_evidence = fits_ && header_.has_evidence();
  rounds_[kRough].left = fits_ ? kTileCounts[kRough] : 0;
  rounds_[kFine].left = has_evidence ? kTileCounts[kFine] : 0;
  rounds_[kCells].left = has_evidence ? window_.end() - rounds_[kCells].next : 0;
}

bool GridSender::compose() {
  if (!is_composing_ && !begin_message()) {
    return false;
  }
  for (std::size_t tiles = 0; tiles < kTilesPerPump && append_tile(); ++tiles) {
  }
  return !is_composing_;
}

bool GridSender::begin_message() {
  std::array<bool, kFlows> is_waiting{};
  for (std::size_t flow = 0; flow < kFlows; ++flow) {
    is_waiting[flow] = rounds_[flow].left > 0;
  }
  const auto chosen = queue_.next(is_waiting);
  if (!chosen) {
    return false;
  }
  is_composing_ = true;
  flow_ = *chosen;
  const Round& round = rounds_[flow_];
  tile_ = round.next;
  end_tile_ = std::min(round.next + round.left, kTileCounts[flow_]);
  writer_.begin_grid(header_, stream::geometry_of_level(kLevels[flow_], grid_));
  writer_.begin_message(tile_);
  return true;
}

bool GridSender::append_tile() {
  const std::size_t tile = find_known(tile_);
  if (tile >= end_tile_) {
    finish_message(end_tile_);
    return false;
  }
  const tile_coding::EncodedTile encoded = encoder_.encode(cells_of(tile), 0, {}, payload_);
  if (!writer_.append(tile, encoded.encoding, std::span(payload_).first(encoded.bytes))) {
    finish_message(tile);
    return false;
  }
  tile_ = tile + 1;
  return true;
}

void GridSender::finish_message(std::size_t end_tile) {
  const std::span<std::byte> message = writer_.finish(end_tile, sequence_);
  ++sequence_;
  sender_.protect(message);
  const std::size_t bytes = framing::encode_cobs(message, frame_);
  require(bytes > 0);
  frame_left_ = std::span(frame_).first(bytes);
  queue_.charge(flow_, bytes);
  Round& round = rounds_[flow_];
  round.left -= end_tile - round.next;
  round.next = end_tile % kTileCounts[flow_];
  is_composing_ = false;
}

// The flow's first known tile with a number of at least `tile`, or one past the grid's last tile.
std::size_t GridSender::find_known(std::size_t tile) const {
  if (flow_ == kCells) {
    const std::size_t place = window_.find(tile);
    return place < window_.count() ? window_.number(place) : geometry::kTileCount;
  }
  if (flow_ == kRough) {
    return coarse_.is_rough_known() ? tile : kTileCounts[kRough];
  }
  while (tile < kTileCounts[kFine] && !coarse_.is_fine_known(tile)) {
    ++tile;
  }
  return tile;
}

tile_coding::TileCells GridSender::cells_of(std::size_t tile) {
  switch (flow_) {
    case kRough:
      coarse_.copy_rough(rough_);
      return rough_;
    case kFine:
      return coarse_.fine(tile);
    default:
      return window_.cells(window_.find(tile));
  }
}

}  // namespace iog::serial
