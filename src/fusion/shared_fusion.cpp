#include "fusion/shared_fusion.hpp"

#include <algorithm>
#include <functional>

#include "require/require.hpp"

namespace iog::fusion {
namespace {

template <typename Packet>
void add_all(FrameFusion& fusion, const vehicle::Sensor& sensor, const Packet& packet,
             Fates& fates) {
  fusion.add_all(sensor, packet,
                 [&](vehicle::Fate fate) { ++fates[static_cast<std::size_t>(fate)]; });
}

}  // namespace

SharedFusion::SharedFusion(const vehicle::Vehicle& vehicle, const intake::WatchedSectors& watched,
                           HelpersSpace space)
    : own_(vehicle), grounds_(vehicle), vehicle_(&vehicle), watched_(&watched), space_(space) {
  own_.follow(grounds_);
  for (FrameFusion& fusion : space_.fusions) {
    fusion.follow(grounds_);
  }
}

void SharedFusion::add_points(FrameFusion& fusion, std::size_t sensor, const intake::Packet& packet,
                              Fates& fates) const {
  const vehicle::Sensor& its = vehicle_->sensors[sensor];
  if (its.no_return_clears_mm == 0) {
    add_all(fusion, its, packet, fates);
  } else {
    const intake::AzimuthParts silent = watched_->silent_azimuths(sensor, packet);
    add_all(fusion, its, intake::EvidentPacket(packet, silent), fates);
  }
}

void SharedFusion::fuse_kept(const work::Crew& crew, std::size_t parts) {
  deal(1, parts);
  while (fuse_next(crew)) {
  }
  packets_.clear();
}

bool SharedFusion::fuse_next(const work::Crew& crew) {
  round_ = parts_.next_round();
  if (round_.empty()) {
    return false;
  }
  if (round_.size() > kPartPlaces - waiting_) {
    join(crew);
  }
  require(waiting_ + round_.size() <= space_.parts.size());
  first_ = waiting_;
  waiting_ += round_.size();
  const std::span<FusedPart> fused = space_.parts.subspan(first_, round_.size());
  crew.share(round_.size(), [&](std::size_t item, std::size_t core) {
    fuse_part(round_[item], core == 0 ? own_ : space_.fusions[core - 1], fused[item]);
  });
  for (const FusedPart& part : fused) {
    std::ranges::transform(fates_, part.fates, fates_.begin(), std::plus());
  }
  return true;
}

void SharedFusion::fuse_part(const FramePart& part, FrameFusion& fusion, FusedPart& fused) const {
  fused.fates = {};
  for (const std::uint16_t number : parts_.packets_of(part)) {
    add_points(fusion, packets_.packets()[number].sensor, packets_.decoded(number), fused.fates);
  }
  fusion.finish();
  fused.tiles.move_from(fusion);
}

// The first join of a frame clears each tile before it adds to it, so a lost core's task can be
// repeated. Later joins add to existing content and cannot be repeated, so core 0 does them alone.
void SharedFusion::join(const work::Crew& crew) {
  const bool is_first = !is_joined_;
  const work::Crew alone;
  (is_first ? crew : alone)
      .share(geometry::kTilesPerSide,
             [&](std::size_t row, std::size_t /*core*/) { join_row(row, is_first); });
  is_joined_ = true;
  waiting_ = 0;
}

void SharedFusion::join_row(std::size_t row, bool is_first) {
  for (std::size_t column = 0; column < geometry::kTilesPerSide; ++column) {
    const std::size_t tile = row * geometry::kTilesPerSide + column;
    if (is_first) {
      joined_.forget(tile);
    }
    for (const FusedPart& part : space_.parts.first(waiting_)) {
      if (part.tiles.is_known(tile)) {
        joined_.add(tile, part.tiles.tile(tile));
      }
    }
  }
}

void SharedFusion::end_frame(const intake::Intake& intake) {
  using LowsAre = ground::Grounds::LowsAre;
  for (std::size_t sensor = 0; sensor < vehicle_->sensors.size(); ++sensor) {
    const std::optional<std::size_t> place = grounds_.place_of(sensor);
    if (!place) {
      continue;
    }
    const LowsAre lows = grounds_.end_frame(sensor, intake.swept_ticks(sensor));
    if (lows == LowsAre::kOfTurn) {
      join_lows(*place);
      grounds_.close_turn(sensor, own_.lows(*place));
    }
    if (lows != LowsAre::kKept) {
      clear_lows(*place);
    }
  }
}

// A lost core may have collected the lowest returns of packets that were then fused again. Minima
// do not change if a value is added twice.
void SharedFusion::join_lows(std::size_t place) {
  for (FrameFusion& fusion : space_.fusions) {
    own_.lows(place).join(fusion.lows(place));
  }
}

void SharedFusion::clear_lows(std::size_t place) {
  own_.lows(place).clear();
  for (FrameFusion& fusion : space_.fusions) {
    fusion.lows(place).clear();
  }
}

}  // namespace iog::fusion
