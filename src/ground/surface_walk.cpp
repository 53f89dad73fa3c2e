// Ranges, all in mm. A plausible lowest return is within 14,000. So is every height on which a walk
// stands, because it is such a return or lies between two. A slope is within 360 per bin, so an
// expected height is within 14,000 + 12 * 360 = 18,320, and a plausible return is within 32,320 of
// it. All of this fits 16 bits. Straight ground between two bins: 28,000 * 65,536 < 2^31.
#include "ground/surface_walk.hpp"

#include <algorithm>
#include <span>

namespace iog::ground {
namespace {

// Limits of the first ground of a sector, and of later ground over its expected height. Rises are
// per 1,024 mm along the line. A car beside a high unit hides the road and could become the first
// ground. The first ground is therefore at most kStart plus kStartRise above the car's plane. The
// rise may be kSteepStartRise if it is at most kOverLast above the surface of the last turn. It is
// also at most kStart above the car's plane and the last turn's ground in most of three sectors, if
// that is known. The sectors are so far apart that few cars are in two of them.
constexpr std::int32_t kStart = 150;
constexpr std::int32_t kStartRise = 20;
constexpr std::int32_t kSteepStartRise = 80;
constexpr std::int16_t kOverLast = 60;
constexpr std::size_t kApart = 24;  // sectors
constexpr std::int16_t kUnknown = Lows::kNothing - kStart;
constexpr std::int32_t kStep = 100;
constexpr std::int32_t kStepRise = 100;
// A far and high first ground may be the lower edge of an object that hides the road. The walk's
// steps are smaller until kProofs more bins have ground of their own.
constexpr std::int32_t kHighStart = 60;
constexpr std::size_t kNearBins = 3;
constexpr std::int16_t kProofs = 3;
constexpr std::int16_t kDoubtfulWidest = 200;
constexpr std::int16_t kWidest = 300;
constexpr std::int32_t kSteepest = 180;
constexpr std::int16_t kReach = 12;  // bins for which a slope continues without ground
constexpr std::int32_t kBeside = 60;
constexpr std::size_t kAcross = 8;  // sectors searched for ground on each side
// A mirror image, of a wall or of the car itself, is at most this wide.
constexpr std::size_t kMirroredSectors = 3;

static_assert(2 * Bins::kMostPlausibleMm + kReach * 2 * kSteepest <= 32'767);
static_assert(std::int64_t{2} * Bins::kMostPlausibleMm * 65'536 < std::int64_t{1} << 31);
static_assert(kStart + 2 * kSteepStartRise * std::int32_t{kBins} <= 32'767);
static_assert(Surface::kMost + kOverLast <= 32'767);

using Inverses = std::array<std::int32_t, kBins + 1>;

// floor(2^16 / n)
consteval Inverses make_inverses() {
  Inverses inverses{};
  for (std::size_t n = 1; n < inverses.size(); ++n) {
    inverses[n] = static_cast<std::int32_t>(65'536 / n);
  }
  return inverses;
}
constexpr Inverses kInverses = make_inverses();

constexpr std::int16_t narrow(std::int32_t value) { return static_cast<std::int16_t>(value); }

// Masks are all ones or zeros. Selection by a mask needs no branch, so eight sectors are processed
// at once.
constexpr std::int16_t mask(bool is_set) { return narrow(is_set ? -1 : 0); }
constexpr std::int16_t pick(std::int16_t mask, std::int16_t yes, std::int16_t no) {
  return narrow((yes & mask) | (no & ~mask));
}

constexpr std::int16_t median(std::int16_t a, std::int16_t b, std::int16_t c) {
  return std::max(std::min(a, b), std::min(std::max(a, b), c));
}

constexpr std::int16_t most_plausible(Bins bins, std::size_t bin) {
  return narrow(bins.most_plausible_mm(static_cast<std::uint32_t>(bin)));
}

// A ring padded at both ends with the sectors from its other end.
constexpr std::size_t kPadding = kApart;
using Around = std::array<std::int16_t, kSectors + 2 * kPadding>;

// value_of(sector) gives the value of each sector.
template <typename ValueOf>
Around around(ValueOf&& value_of) {
  Around values;
  for (std::size_t sector = 0; sector < kSectors; ++sector) {
    values[kPadding + sector] = value_of(sector);
  }
  std::copy_n(values.begin() + kSectors, kPadding, values.begin());
  std::copy_n(values.begin() + kPadding, kPadding, values.end() - kPadding);
  return values;
}

// The value this many sectors forward or back.
template <bool kForward>
std::int16_t farther(const Around& from, std::size_t sector, std::size_t distance) {
  return from[kForward ? kPadding + sector + distance : kPadding + sector - distance];
}

// The nearest value in one direction that is not kNothing. `near` has it for the next `sectors`
// sectors; the result has it for twice as many.
template <bool kForward>
Around of_twice_as_many(const Around& near, std::size_t sectors) {
  return around([&](std::size_t sector) {
    const std::int16_t at_hand = near[kPadding + sector];
    return pick(mask(at_hand == Lows::kNothing), farther<kForward>(near, sector, sectors), at_hand);
  });
}

template <bool kForward>
Around nearest_beside(const Around& ring) {
  static_assert(kAcross == 8);
  const Around of_one =
      around([&](std::size_t sector) { return farther<kForward>(ring, sector, 1); });
  const Around of_two = of_twice_as_many<kForward>(of_one, 1);
  const Around of_four = of_twice_as_many<kForward>(of_two, 2);
  return of_twice_as_many<kForward>(of_four, 4);
}

// Maps a lowest return to none if it is implausibly high, or if it is far below the car's plane and
// the lowest returns on both sides.
void believe(Bins bins, std::size_t bin, const Lows::Ring& lows, Lows::Ring& believed) {
  const std::int16_t plausible = most_plausible(bins, bin);
  const Around ring = around([&](std::size_t sector) {
    return pick(mask(lows[sector] > plausible), Lows::kNothing, lows[sector]);
  });
  for (std::size_t sector = 0; sector < kSectors; ++sector) {
    const std::int16_t low = ring[kPadding + sector];
    const std::int16_t left = farther<true>(ring, sector, kMirroredSectors);
    const std::int16_t right = farther<false>(ring, sector, kMirroredSectors);
    const std::int16_t are_both = mask(std::max(left, right) != Lows::kNothing);
    const std::int16_t is_deep = mask(std::min<std::int16_t>({left, right, 0}) - low > kMirroredMm);
    believed[sector] = pick(narrow(are_both & is_deep), Lows::kNothing, low);
  }
}

}  // namespace

void SurfaceWalk::close_turn(Bins bins, const Lows& lows, Surface& surface) {
  begin(surface);
  for (std::size_t bin = 0; bin < kBins; ++bin) {
    expect(bins, bin, lows.ring(bin));
    turn_slopes(bins, bin);
    choose();
    catch_up(bins, bin);
    doubt(bin);
    stand(bin);
  }
  go_straight_on();
  outvote();
  find_starts();
  keep_low(bins, lows);
  renew(lows, surface);
}

void SurfaceWalk::begin(const Surface& surface) {
  for (std::size_t sector = 0; sector < kSectors; ++sector) {
    const Surface::Row& row = surface.row(sector);
    for (std::size_t start = 0; start < row.size(); ++start) {
      ground_[start][sector] = row[start];
    }
  }
  height_.fill(0);
  slope_.fill(0);
  last_.fill(-1);
  doubt_.fill(0);
}

void SurfaceWalk::expect(Bins bins, std::size_t bin, const Ring& lows) {
  const auto number = static_cast<std::int16_t>(bin);
  const std::int16_t start = narrow(kStart + bins.rise_of_bin(kStartRise) * (number + 1));
  const std::int16_t steep_start =
      narrow(kStart + bins.rise_of_bin(kSteepStartRise) * (number + 1));
  const std::int16_t step_rise = narrow(bins.rise_of_bin(kStepRise));
  // Of the last turn.
  const Ring& bin_start = ground_[bin];
  const Ring& bin_end = ground_[bin + 1];
  // Where the last turn found no ground, its height is exactly 0.
  const Around last_turn = around([&](std::size_t sector) {
    const std::int16_t height = narrow((bin_start[sector] + bin_end[sector]) >> 1);
    return pick(mask(height == 0), kUnknown, height);
  });
  believe(bins, bin, lows, low_);
  for (std::size_t sector = 0; sector < kSectors; ++sector) {
    const std::int16_t over_last = narrow(((bin_start[sector] + bin_end[sector]) >> 1) + kOverLast);
    const std::int16_t apart =
        median(farther<true>(last_turn, sector, kApart), last_turn[kPadding + sector],
               farther<false>(last_turn, sector, kApart));
    const std::int16_t over_apart = narrow(std::max<std::int16_t>(apart, 0) + kStart);
    const std::int16_t first =
        std::min(std::max(start, std::min(steep_start, over_last)), over_apart);
    const std::int16_t last = last_[sector];
    const std::int16_t gap = std::min(narrow(number - last), kReach);
    const std::int16_t expected = narrow(height_[sector] + slope_[sector] * gap);
    const std::int16_t widest = pick(mask(doubt_[sector] > 0), kDoubtfulWidest, kWidest);
    const std::int16_t step = std::min(narrow(kStep + step_rise * gap), widest);
    const std::int16_t most = pick(mask(last < 0), first, step);
    const std::int16_t low = low_[sector];
    const std::int16_t off = narrow(low - expected);
    expected_[sector] = expected;
    most_[sector] = most;
    const std::int16_t is_ground = narrow(mask(low != Lows::kNothing) & mask(off <= most));
    own_[sector] = pick(is_ground, low, Lows::kNothing);
  }
}

// Corrects the slope by a quarter of the error, unless the error is too large for the same ground.
// For sectors that missed bins, catch_up() does this.
void SurfaceWalk::turn_slopes(Bins bins, std::size_t bin) {
  const std::int16_t steepest = narrow(bins.rise_of_bin(kSteepest));
  const std::int16_t before = narrow(static_cast<std::int32_t>(bin) - 1);
  for (std::size_t sector = 0; sector < kSectors; ++sector) {
    const std::int16_t off = narrow(low_[sector] - expected_[sector]);
    const std::int16_t slope = slope_[sector];
    const std::int16_t turned = narrow(slope + (off >> 2));
    const std::int16_t kept = std::min(std::max(turned, narrow(-steepest)), steepest);
    const std::int16_t is_next = mask(last_[sector] == before);
    const std::int16_t is_near = mask(off >= narrow(-most_[sector]));
    const std::int16_t is_ground = mask(own_[sector] != Lows::kNothing);
    slope_[sector] = pick(narrow(is_ground & is_next & is_near), kept, slope);
  }
}

// Chooses the ground of the current bin: the sector's own, or that of the sectors beside it.
void SurfaceWalk::choose() {
  const Around ring = around([&](std::size_t sector) { return own_[sector]; });
  const Around lefts = nearest_beside<true>(ring);
  const Around rights = nearest_beside<false>(ring);
  for (std::size_t sector = 0; sector < kSectors; ++sector) {
    const std::int16_t some_left = lefts[kPadding + sector];
    const std::int16_t some_right = rights[kPadding + sector];
    const std::int16_t left = pick(mask(some_left == Lows::kNothing), some_right, some_left);
    const std::int16_t right = pick(mask(some_right == Lows::kNothing), some_left, some_right);
    const std::int16_t low = low_[sector];
    const std::int16_t beside = narrow(left + (narrow(right - left) >> 1));
    const std::int16_t off = narrow(beside - expected_[sector]);
    const std::int16_t most = std::max(most_[sector], kWidest);
    const std::int16_t highest = narrow(std::max(left, right) + kBeside);
    const std::int16_t is_some = mask(left != Lows::kNothing);
    const std::int16_t is_low = narrow(mask(low != Lows::kNothing) & mask(low <= highest));
    const std::int16_t fits = narrow(mask(off <= most) & mask(off >= narrow(-most)));
    const std::int16_t is_own = narrow(mask(own_[sector] != Lows::kNothing) | (is_some & is_low));
    found_[sector] = pick(is_own, low, beside);
    stands_[sector] = narrow(is_own | (is_some & fits));
  }
}

// Handles sectors that find ground again after bins without any. In most bins they are few.
void SurfaceWalk::catch_up(Bins bins, std::size_t bin) {
  const std::int16_t before = narrow(static_cast<std::int32_t>(bin) - 1);
  Ring missed;
  for (std::size_t sector = 0; sector < kSectors; ++sector) {
    missed[sector] = narrow(stands_[sector] & mask(last_[sector] != before));
  }
  for (std::size_t sector = 0; sector < kSectors; ++sector) {
    if (missed[sector] != 0) {
      catch_up(bins, bin, sector);
    }
  }
}

// Corrects the slope and fills the gap with straight ground.
void SurfaceWalk::catch_up(Bins bins, std::size_t bin, std::size_t sector) {
  const std::int32_t steepest = bins.rise_of_bin(kSteepest);
  const std::int32_t gap = static_cast<std::int32_t>(bin) - last_[sector];
  const std::int32_t inverse = kInverses[static_cast<std::size_t>(gap)];
  const std::int32_t off = low_[sector] - expected_[sector];
  if (own_[sector] != Lows::kNothing && off >= -most_[sector]) {
    const std::int32_t turned = slope_[sector] + ((off * inverse) >> 18);
    slope_[sector] = narrow(std::clamp(turned, -steepest, steepest));
  }
  const std::int32_t each = (found_[sector] - height_[sector]) * inverse;
  for (std::int32_t i = 1; i < gap; ++i) {
    ground_[bin - static_cast<std::size_t>(gap - i)][sector] =
        narrow(height_[sector] + ((each * i) >> 16));
  }
}

// A far and high first ground of a sector starts the doubt. Each later ground of the sector's own
// reduces it.
void SurfaceWalk::doubt(std::size_t bin) {
  const std::int16_t begin = bin < kNearBins ? std::int16_t{0} : kProofs;
  for (std::size_t sector = 0; sector < kSectors; ++sector) {
    const std::int16_t is_first = narrow(stands_[sector] & mask(last_[sector] < 0));
    const std::int16_t at_first = pick(mask(found_[sector] > kHighStart), begin, 0);
    const std::int16_t left = doubt_[sector];
    const std::int16_t is_less = narrow(mask(own_[sector] != Lows::kNothing) & mask(left > 0));
    doubt_[sector] = pick(is_first, at_first, narrow(left + is_less));
  }
}

void SurfaceWalk::stand(std::size_t bin) {
  Ring& ground = ground_[bin];
  for (std::size_t sector = 0; sector < kSectors; ++sector) {
    const bool stands = stands_[sector] != 0;
    ground[sector] = found_[sector];
    height_[sector] = stands ? found_[sector] : height_[sector];
    last_[sector] = stands ? narrow(static_cast<std::int32_t>(bin)) : last_[sector];
  }
}

// Continues the ground beyond the last bin of each sector that has some.
void SurfaceWalk::go_straight_on() {
  for (std::size_t bin = 0; bin < kBins; ++bin) {
    Ring& ground = ground_[bin];
    for (std::size_t sector = 0; sector < kSectors; ++sector) {
      const std::int16_t beyond = narrow(static_cast<std::int32_t>(bin) - last_[sector]);
      const std::int16_t on = narrow(height_[sector] + slope_[sector] * std::min(beyond, kReach));
      ground[sector] = beyond > 0 ? on : ground[sector];
    }
  }
}

void SurfaceWalk::outvote() {
  for (Ring& ground : std::span(ground_).first(kBins)) {
    const Around ring = around([&](std::size_t sector) { return ground[sector]; });
    for (std::size_t sector = 0; sector < kSectors; ++sector) {
      const std::int16_t* at = &ring[kPadding + sector];
      ground[sector] = median(at[-1], at[0], at[1]);
    }
  }
}

// Converts heights in the middle of bins into heights at their starts, half way between two
// middles, and at the end of the last bin.
void SurfaceWalk::find_starts() {
  Ring before = ground_[kBins - 2];
  const Ring& last = ground_[kBins - 1];
  for (std::size_t sector = 0; sector < kSectors; ++sector) {
    const std::int32_t end = last[sector] + ((last[sector] - before[sector]) >> 1);
    ground_[kBins][sector] = narrow(std::clamp(end, -Surface::kMost, Surface::kMost));
  }
  before.fill(0);
  for (std::size_t bin = 0; bin < kBins; ++bin) {
    Ring& ground = ground_[bin];
    for (std::size_t sector = 0; sector < kSectors; ++sector) {
      const std::int16_t middle = ground[sector];
      ground[sector] = narrow((before[sector] + middle) >> 1);
      before[sector] = middle;
    }
  }
  ground_[0].fill(0);
}

// Limits the height of the surface over the lowest believed return of each bin.
void SurfaceWalk::keep_low(Bins bins, const Lows& lows) {
  for (std::size_t bin = 0; bin < kBins; ++bin) {
    believe(bins, bin, lows.ring(bin), low_);
    Ring& start = ground_[bin];
    Ring& end = ground_[bin + 1];
    for (std::size_t sector = 0; sector < kSectors; ++sector) {
      const std::int16_t low = low_[sector];
      const std::int16_t most =
          narrow(std::min(low, narrow(Surface::kMost - kMostOverLowestMm)) + kMostOverLowestMm);
      start[sector] = std::min(start[sector], most);
      end[sector] = std::min(end[sector], most);
    }
  }
}

void SurfaceWalk::renew(const Lows& lows, Surface& surface) const {
  Ring lowest{};
  lowest.fill(Lows::kNothing);
  for (std::size_t bin = 0; bin < kBins; ++bin) {
    for (std::size_t sector = 0; sector < kSectors; ++sector) {
      lowest[sector] = std::min(lowest[sector], lows.ring(bin)[sector]);
    }
  }
  for (std::size_t sector = 0; sector < kSectors; ++sector) {
    if (lowest[sector] == Lows::kNothing) {
      surface.keep(sector);
      continue;
    }
    Surface::Row& row = surface.renew(sector);
    for (std::size_t start = 0; start < row.size(); ++start) {
      row[start] = ground_[start][sector];
    }
  }
}

}  // namespace iog::ground
