#include "intake/blocked_sectors.hpp"

#include <algorithm>
#include <bit>
#include <span>

#include "geometry/grid.hpp"
#include "vehicle/beam.hpp"

namespace iog::intake {
namespace {

constexpr std::int64_t kGroundMm = 20'000;
constexpr std::int64_t kSteepest = 16;  // a ground beam falls by at least 1 in 16
constexpr std::uint32_t kFewestBeams = 4;
constexpr std::uint32_t kBlockedPart = 16;
constexpr std::uint32_t kOpenPart = 8;
constexpr std::uint8_t kEmptyTurns = 3;

constexpr bool contains(const lidar::Sector& sector, std::uint32_t azimuth_ticks,
                        std::uint32_t ticks_per_turn) {
  const std::uint32_t turn = azimuth_ticks < sector.first_ticks ? ticks_per_turn : 0;
  return azimuth_ticks + turn - sector.first_ticks < sector.width_ticks;
}

}  // namespace

BlockedSectors::BlockedSectors(const vehicle::Sensor& sensor, const SectorView& view)
    : sensor_(&sensor), view_(&view), turns_(lidar::turns(sensor.format)) {
  find_likely_sectors();
  const std::size_t layers = sensor.layer_count;
  sampled_count_ = static_cast<std::uint8_t>(std::min(layers, kMaxSampled));
  for (std::size_t i = 0; i < sampled_count_; ++i) {
    sampled_[i] = static_cast<std::uint8_t>(i * layers / sampled_count_);
  }
  for (std::size_t i = 0; i < kSectors; ++i) {
    kinds_[i] = kind_of(i);
  }
  if (std::ranges::count(kinds_, Kind::kGround) > 0) {
    std::ranges::replace(kinds_, Kind::kLevel, Kind::kSky);
  } else if (std::ranges::count(kinds_, Kind::kLevel) == 0) {
    std::ranges::replace(kinds_, Kind::kSky, Kind::kOpen);
  }
  for (std::size_t i = 0; i < kSectors; ++i) {
    const bool is_reached = kinds_[i] != Kind::kUnseen;
    reached_ |= std::uint64_t{is_reached ? 1U : 0U} << i;
    judged_ |= std::uint64_t{is_reached && kinds_[i] != Kind::kSky ? 1U : 0U} << i;
  }
  state_.levels.fill(kFull);
}

// The beams in the middle of the sector, on the car's plane, decide. Heights are in subcells below
// 2^31, ranges in millimetres below 2^20.
BlockedSectors::Kind BlockedSectors::kind_of(std::size_t sector) {
  const lidar::Sector& seen = (*view_)[sector];
  if (seen.width_ticks == 0) {
    return Kind::kUnseen;
  }
  const std::uint32_t middle =
      (seen.first_ticks + seen.width_ticks / 2U) % sensor_->azimuths.ticks_per_turn();
  const vehicle::Direction direction =
      vehicle::direction_of(*sensor_, sensor_->azimuths.nearest(middle));
  const std::int64_t range_mm = sensor_->range.mm();
  const std::int64_t range = sensor_->grid.subcells(static_cast<std::int32_t>(range_mm));
  Kind kind = Kind::kSky;
  for (const std::uint8_t layer : std::span(sampled_).first(sampled_count_)) {
    const std::int64_t drop =
        sensor_->origin_z - vehicle::end_height_of(sensor_->layers[layer], direction);
    if (turns_ && drop * kSteepest >= range && sensor_->origin_z * range_mm <= kGroundMm * drop) {
      low_layers_[sector][layer / 32] |= std::uint32_t{1} << layer % 32;
      kind = Kind::kGround;
    } else if (kind == Kind::kSky && drop >= sensor_->origin_z) {
      kind = Kind::kLevel;
    }
  }
  return kind;
}

// An interval whose start is in no sector has that of the interval before.
void BlockedSectors::find_likely_sectors() {
  const std::uint32_t last_tick = sensor_->azimuths.ticks_per_turn() - 1;
  likely_shift_ = static_cast<std::uint8_t>(std::bit_width(last_tick / kLikely));
  for (std::uint32_t i = 0; i <= last_tick >> likely_shift_; ++i) {
    likely_[i] = i == 0 ? std::uint8_t{0} : likely_[i - 1];
    const std::size_t sector = sector_of(i << likely_shift_);
    likely_[i] = sector == kSectors ? likely_[i] : static_cast<std::uint8_t>(sector);
  }
}

// Returns kSectors if no sector contains the azimuth. The search begins at the likely sector and
// widens to both sides.
std::size_t BlockedSectors::sector_of(std::uint32_t azimuth_ticks) const {
  const std::uint32_t turn = sensor_->azimuths.ticks_per_turn();
  const std::size_t likely = likely_[azimuth_ticks >> likely_shift_];
  if (contains((*view_)[likely], azimuth_ticks, turn)) [[likely]] {
    return likely;
  }
  for (std::size_t i = 1; i < kSectors; ++i) {
    const std::size_t beside = i % 2 == 0 ? i / 2 : kSectors - (i + 1) / 2;
    const std::size_t sector = (likely + beside) % kSectors;
    if (contains((*view_)[sector], azimuth_ticks, turn)) {
      return sector;
    }
  }
  return kSectors;
}

bool BlockedSectors::is_return(const lidar::ScanPoint& point) const {
  return point.range_mm != 0 && point.range_mm >= sensor_->range_min_mm && !point.is_dirt &&
         !point.is_rain;
}

void BlockedSectors::Sums::keep_within_limits() {
  beams = std::min(beams, kMost);
  returns = std::min(returns, kMost);
}

void BlockedSectors::add(const Packet& packet) {
  lidar::Sector decided{};  // no further point in it changes anything
  const auto look = [&](const lidar::ScanPoint& point) {
    const bool comes_back = is_return(point);
    frame_returns_ += comes_back ? 1U : 0U;
    const std::size_t sector = sector_of(point.azimuth_ticks);
    if (sector == kSectors) {
      return;
    }
    all_[sector].add(point.echo == 0, comes_back);
    if (is_judged(sector, point)) {
      sums_[sector].add(point.echo == 0, comes_back);
    }
    if (!turns_) {
      decided = is_decided(sector) ? (*view_)[sector] : lidar::Sector{};
    }
  };
  if (turns_) {
    const auto layers = std::span(sampled_).first(sampled_count_);
    packet.for_each_sample({.layers = layers, .log2_firings = layers.size() <= 16 ? 2 : 1}, look);
  } else {
    // This is inlined so that, for most points, only the azimuth is decoded.
    const std::uint32_t turn = sensor_->azimuths.ticks_per_turn();
    packet.for_each_point([&](const lidar::ScanPoint& point) __attribute__((always_inline)) {
      if (!contains(decided, point.azimuth_ticks, turn)) {
        const lidar::ScanPoint undecided = point;
        look(undecided);
      }
    });
  }
}

// A unit that does not spin needs one return, unless a sector is open.
bool BlockedSectors::is_decided(std::size_t sector) const {
  return frame_returns_ > 0 && kinds_[sector] != Kind::kOpen &&
         (kinds_[sector] != Kind::kLevel || sums_[sector].returns > 0);
}

// A turn that lost up to an eighth still counts as a turn.
bool BlockedSectors::is_over(std::uint32_t swept_ticks, std::uint64_t swept) const {
  return turns_
             ? swept_ticks > 0 && 8 * (turn_ticks_ + swept_ticks) >= 7U * sensor_->scan_width_ticks
             : swept != 0;
}

// Calls visit(sector) for each sector that the turn or scan has seen. If a spinning unit has only a
// few beams in a sector, they are kept until its next turn.
template <typename Visit>
void BlockedSectors::for_each_seen(std::uint64_t swept, Visit&& visit) const {
  for (std::uint64_t left = turns_ ? reached_ : reached_ & swept; left != 0; left &= left - 1) {
    const auto sector = static_cast<std::size_t>(std::countr_zero(left));
    const Sums& sums = kinds_[sector] == Kind::kOpen ? all_[sector] : sums_[sector];
    if (!turns_ || sums.beams >= kFewestBeams) {
      visit(sector);
    }
  }
}

int BlockedSectors::level_after(std::size_t sector) const {
  const Sums& sums = sums_[sector];
  const int level = state_.levels[sector];
  if (kinds_[sector] == Kind::kLevel) {
    return level + (sums.returns > 0 ? kFull / 2 : -kFull / 32);
  }
  if (kinds_[sector] == Kind::kOpen) {
    return level + (sums.are_below(kBlockedPart) ? -kFull / 32 : kFull / 2);
  }
  const auto are_below = [&](std::uint32_t part) {
    const bool have_given = state_.gave[sector] >= kAllGave / 4;
    return sums.are_below(part) && (have_given || all_[sector].are_below(part));
  };
  if (are_below(kBlockedPart)) {
    return 0;
  }
  return level + (are_below(kOpenPart) ? 0 : kFull / 3);
}

BlockedSectors::State BlockedSectors::after_frame(std::uint32_t swept_ticks,
                                                  std::uint64_t swept) const {
  State after = state_;
  if (!is_over(swept_ticks, swept)) {
    return after;
  }
  const bool is_empty = turn_returns_ + frame_returns_ == 0;
  after.empty_turns =
      static_cast<std::uint8_t>(is_empty ? std::min<int>(state_.empty_turns + 1, kEmptyTurns) : 0);
  for_each_seen(swept, [&](std::size_t i) {
    const std::uint64_t bit = std::uint64_t{1} << i;
    after.seen |= bit;
    if ((judged_ & bit) == 0) {
      return;
    }
    const bool is_empty_unit = after.empty_turns == kEmptyTurns && kinds_[i] != Kind::kOpen;
    const int level = is_empty_unit ? 0 : level_after(i);
    after.levels[i] = static_cast<std::int16_t>(std::clamp(level, 0, int{kFull}));
    if (level > 0 && kinds_[i] == Kind::kGround) {
      after.gave[i] =
          static_cast<std::uint16_t>(state_.gave[i] - state_.gave[i] / 32 +
                                     std::min<std::uint32_t>(sums_[i].returns, sums_[i].beams) *
                                         (kAllGave / 32) / sums_[i].beams);
    }
    after.blocked |= after.levels[i] == 0 ? bit : 0;
    after.blocked &= after.levels[i] == kFull ? ~bit : ~std::uint64_t{0};
  });
  const std::uint64_t judged = judged_ & after.seen;
  after.blocked &= judged;
  if (judged != 0 && after.blocked == judged) {
    after.blocked = after.seen;
  }
  return after;
}

void BlockedSectors::end_frame(std::uint32_t swept_ticks, std::uint64_t swept) {
  state_ = after_frame(swept_ticks, swept);
  const bool ends_turn = is_over(swept_ticks, swept);
  if (ends_turn) {
    for_each_seen(swept, [&](std::size_t i) {
      sums_[i] = {};
      all_[i] = {};
    });
  }
  for (std::size_t i = 0; i < kSectors; ++i) {
    sums_[i].keep_within_limits();
    all_[i].keep_within_limits();
  }
  turn_ticks_ = ends_turn ? 0 : turn_ticks_ + swept_ticks;
  turn_returns_ = ends_turn ? 0 : turn_returns_ + frame_returns_;
  frame_returns_ = 0;
}

AzimuthParts BlockedSectors::silent_azimuths(const Packet& packet) const {
  std::array<Sums, AzimuthParts::kParts> sums{};
  AzimuthParts silent(sensor_->azimuths.ticks_per_turn());
  std::array<bool, AzimuthParts::kParts> are_blocked{};
  std::array<bool, AzimuthParts::kParts> are_met{};
  std::array<bool, AzimuthParts::kParts> are_open{};
  packet.for_each_point([&](const lidar::ScanPoint& point) {
    const std::size_t part = silent.part_of(point.azimuth_ticks);
    const std::size_t its = sector_of(point.azimuth_ticks);
    are_met[part] = true;
    are_blocked[part] |= its != kSectors && (state_.blocked >> its & 1U) != 0;
    are_open[part] |= its != kSectors && kinds_[its] == Kind::kOpen;
    if (its == kSectors || is_judged(its, point)) {
      sums[part].add(point.echo == 0, is_return(point));
    }
  });
  const auto is_silent = [&](std::size_t part) {
    return are_blocked[part] || sums[part].are_below(kBlockedPart) ||
           (sums[part].beams == 0 && !are_open[part]);
  };
  for (std::size_t i = 0; i < AzimuthParts::kParts; ++i) {
    for (const std::size_t beside : {i + AzimuthParts::kParts - 1, i, i + 1}) {
      const std::size_t part = beside % AzimuthParts::kParts;
      if (are_met[part] && is_silent(part)) {
        silent.add(i);
      }
    }
  }
  return silent;
}

void EvidentPacket::visit_points(void* its,
                                 void (*visit)(void* its, const lidar::ScanPoint& point)) const {
  packet_->for_each_point([&](lidar::ScanPoint point) {
    if (point.range_mm == 0 && silent_->contain(point.azimuth_ticks)) {
      point.echo = 1;  // only the first echo of a beam carves the beam
    }
    visit(its, point);
  });
}

}  // namespace iog::intake
