#include "tile_coding/encode.hpp"

#include <algorithm>

#include "wire/byte_order.hpp"

namespace iog::tile_coding {
namespace {

constexpr std::size_t kFrameNumberBytes = 4;

constexpr std::size_t index_of(Encoding encoding) { return static_cast<std::size_t>(encoding); }

}  // namespace

EncodedTile Encoder::encode(TileCells cells, const std::optional<Reference>& reference,
                            MutableTileCells payload) {
  survey_since(cells, reference);
  Encoding encoding = Encoding::kChangedSince;
  if (!reference || sizes_[index_of(encoding)] > reference->bytes) {
    survey_alone(cells);
    encoding = static_cast<Encoding>(std::ranges::min_element(sizes_) - sizes_.begin());
  }
  return {.encoding = encoding, .bytes = write(encoding, cells, reference, payload)};
}

EncodedTile Encoder::encode_as(Encoding encoding, TileCells cells,
                               const std::optional<Reference>& reference,
                               MutableTileCells payload) {
  survey_since(cells, reference);
  survey_alone(cells);
  const bool is_shorter = sizes_[index_of(encoding)] < kTileBytes;
  const Encoding chosen = is_shorter ? encoding : Encoding::kRaw;
  return {.encoding = chosen, .bytes = write(chosen, cells, reference, payload)};
}

// Both need the changes; this one comes first.
void Encoder::survey_since(TileCells cells, const std::optional<Reference>& reference) {
  changes_.mark_changes(cells);
  sizes_[index_of(Encoding::kChangedSince)] = kTileBytes;
  if (reference) {
    differences_.mark_differences(cells, reference->cells);
    runs_since_.find(cells, changes_, differences_);
    sizes_[index_of(Encoding::kChangedSince)] = kFrameNumberBytes + runs_since_.coded_bytes();
  }
}

void Encoder::survey_alone(TileCells cells) {
  steps_.mark_steps(cells);
  runs_.find(cells, changes_, steps_);
  quadtree_.find(changes_, steps_);
  sizes_[index_of(Encoding::kRaw)] = kTileBytes;
  sizes_[index_of(Encoding::kRunLength)] = runs_.coded_bytes();
  sizes_[index_of(Encoding::kQuadtree)] = quadtree_.coded_bytes(runs_.palette().values().size());
}

std::size_t Encoder::write(Encoding encoding, TileCells cells,
                           const std::optional<Reference>& reference, MutableTileCells payload) {
  switch (encoding) {
    case Encoding::kRunLength:
      return runs_.write(cells, changes_, payload);
    case Encoding::kQuadtree:
      return quadtree_.write(cells, runs_.palette(), payload);
    case Encoding::kChangedSince:
      wire::store_be32(payload.first<kFrameNumberBytes>(), reference->frame_number);
      return kFrameNumberBytes + runs_since_.write(payload.subspan<kFrameNumberBytes>());
    case Encoding::kRaw:
      break;
  }
  std::ranges::copy(cells, payload.begin());
  return kTileBytes;
}

}  // namespace iog::tile_coding
