#include "tools/frames/tile_messages.hpp"

#include "tools/frames/tile_decoding.hpp"

namespace iog::tools {

bool TileDecoder::decode(const stream::TileRecord& record, std::uint32_t frame_number,
                         TileBytes& cells, MessageCounts& counts) {
  using tile_coding::DecodeStatus;
  switch (tile_coding::decode(record.encoding, record.payload, frame_number,
                              references_->find(record.tile), cells)) {
    case DecodeStatus::kOk:
      break;
    case DecodeStatus::kUnknownEncoding:
      ++counts.tiles_not_understood;
      return false;
    case DecodeStatus::kMalformed:
      ++counts.tiles_malformed;
      return false;
    case DecodeStatus::kUnknownReference:
      ++counts.without_reference;
      return false;
  }
  if (storage_ == stream::Storage::kClass && !stream::are_class_bytes(cells)) {
    ++counts.tiles_malformed;
    return false;
  }
  if (keeps_references_ && stream::stands_by_itself(record.encoding)) {
    references_->keep(record.tile, cells, frame_number, record.payload.size());
  }
  return true;
}

bool TileMessages::take(const stream::TilesHeader& header, const geometry::Grid& grid,
                        std::span<const std::byte> body) {
  if (bodies_.empty()) {
    grid_ = grid;
    for (std::size_t tile = grid.tile_count(); tile < geometry::kTileCount; ++tile) {
      spoken_of_.set(tile);
    }
  }
  if (bodies_.size() == geometry::kTileCount || grid != grid_) {
    return false;
  }
  for (std::size_t tile = header.first_tile; tile < header.end_tile; ++tile) {
    spoken_of_.set(tile);
  }
  bodies_.emplace_back(body.begin(), body.end());
  return true;
}

TileMessages::Tiles TileMessages::decode(TileDecoder& decoder, std::uint32_t frame_number,
                                         MessageCounts& counts, const TileHandler& on_tile) const {
  TileSet known;
  TileSet broken;
  TileBytes cells{};
  for (const std::vector<std::byte>& body : bodies_) {
    stream::TilesHeader header;
    stream::TileRecords records;
    static_cast<void>(stream::read_tiles(body, header, records));  // it was sound when it came
    for (stream::TileRecord record; records.next(record);) {
      if (decoder.decode(record, frame_number, cells, counts)) {
        known.set(record.tile);
        on_tile(record, cells);
      } else {
        broken.set(record.tile);
      }
    }
  }
  const TileSet valid = spoken_of_ & ~broken;
  return {.valid = valid, .known = known & valid};
}

}  // namespace iog::tools
