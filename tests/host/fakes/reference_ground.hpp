// A second implementation of docs/ground.md, section "The rule": slow and plain, one sector after
// the other, in wide integers. It shares no code with src/ground, and has every number once, so
// that a test can change one.
#pragma once

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <cstdlib>
#include <optional>
#include <span>
#include <vector>

namespace iog::tests {

using Whole = std::int64_t;

inline Whole floor_of(Whole dividend, Whole divisor) {
  const Whole quotient = dividend / divisor;
  return quotient * divisor > dividend ? quotient - 1 : quotient;
}

struct GroundRule {
  Whole plausible = 300;
  Whole plausible_rise = 225;
  Whole most_plausible = 14'000;
  Whole start = 150;
  Whole start_rise = 20;
  Whole steep_start_rise = 80;
  Whole over_last = 60;
  Whole over_apart = 150;
  Whole apart = 24;
  Whole step = 100;
  Whole step_rise = 100;
  Whole widest = 300;
  Whole high_start = 60;
  Whole near_starts = 3;
  Whole proofs = 3;
  Whole doubtful_widest = 200;
  Whole slope_parts = 4;  // of an error, one is believed
  Whole steepest = 180;
  Whole reach = 12;
  Whole across = 8;
  Whole beside = 60;
  Whole over_lowest = 150;
  Whole mirrored = 1'000;
  Whole mirrored_sectors = 3;
  Whole turns_kept = 10;
  Whole near_bins = 2;
};

// What a sensor that turns knows of the ground.
class ReferenceGround {
 public:
  // bin_mm: 1,024 or 2,048.
  explicit ReferenceGround(Whole bin_mm, GroundRule rule = {})
      : bin_mm_(bin_mm),
        rule_(rule),
        rows_(kSectors, std::vector<Whole>(kBins + 1, 0)),
        kept_(kSectors) {}

  void see(Whole sector, Whole along_mm, Whole z_mm) {
    const Whole bin = along_mm / bin_mm_;
    if (bin < kBins && z_mm >= -most_plausible(bin) && z_mm < 32'767) {
      std::optional<Whole>& low = lowest_[at(sector * kBins + bin)];
      low = low ? std::min(*low, z_mm) : z_mm;
    }
  }

  void close_turn() {
    walk();
    for (Whole sector = 0; sector < kSectors; ++sector) {
      std::optional<Whole>& kept = kept_[at(sector)];
      if (has_returns(sector)) {
        rows_[at(sector)] = row_of(sector);
        kept = 0;
      } else if (kept && ++*kept > rule_.turns_kept) {
        rows_[at(sector)].assign(kBins + 1, 0);
        kept.reset();
      }
    }
    lowest_.assign(at(kSectors * kBins), {});
  }

  [[nodiscard]] const std::vector<Whole>& row(Whole sector) const { return rows_[at(sector)]; }
  // How many turns ago its row was made; none: it is flat.
  [[nodiscard]] std::optional<Whole> turns_kept(Whole sector) const { return kept_[at(sector)]; }

  [[nodiscard]] Whole height_over(Whole sector, Whole along_mm, Whole z_mm) const {
    return height_over_row(rows_[at(sector)], along_mm, z_mm);
  }

  // The same with each start as high as the highest of those nearby.
  [[nodiscard]] Whole height_over_near(Whole sector, Whole along_mm, Whole z_mm) const {
    const std::vector<Whole>& its = rows_[at(sector)];
    std::vector<Whole> highest = its;
    for (Whole start = 0; start <= kBins; ++start) {
      for (Whole near = 0; near <= kBins; ++near) {
        if (std::abs(near - start) <= rule_.near_bins) {
          highest[at(start)] = std::max(highest[at(start)], its[at(near)]);
        }
      }
    }
    return height_over_row(highest, along_mm, z_mm);
  }

  // Starts as low as the lowest of those nearby, if none was higher or lower by a slope that goes
  // on for six bins on both sides: the smaller of two rises, or of two falls.
  [[nodiscard]] std::vector<Whole> lowest_near(Whole sector) const {
    const std::vector<Whole>& its = rows_[at(sector)];
    const auto height = [&](Whole start) {
      return static_cast<double>(its[at(std::clamp<Whole>(start, 0, kBins))]);
    };
    std::vector<Whole> lowest = its;
    for (Whole start = 0; start <= kBins; ++start) {
      const double before = (height(start) - height(start - 6)) / 6;
      const double behind = (height(start + 6) - height(start)) / 6;
      double slope = 0;
      if (before * behind > 0) {
        slope = std::abs(before) < std::abs(behind) ? before : behind;
      }
      double of_level = height(start);
      double of_slope = height(start);
      for (Whole near = start - rule_.near_bins; near <= start + rule_.near_bins; ++near) {
        if (near >= 0 && near <= kBins) {
          of_level = std::min(of_level, height(near));
          of_slope = std::min(of_slope, height(near) - slope * static_cast<double>(near - start));
        }
      }
      // What is a whole number stays one, whichever way its parts were rounded.
      lowest[at(start)] = static_cast<Whole>(std::max(of_level, std::floor(of_slope + 1e-6)));
    }
    return lowest;
  }

  static constexpr Whole kSectors = 256;
  static constexpr Whole kBins = 64;

 private:
  using Ring = std::vector<std::optional<Whole>>;

  struct Walker {
    Whole height = 0;
    Whole slope = 0;
    Whole bin = -1;
    Whole proofs_missing = 0;
    std::vector<Whole> ground = std::vector<Whole>(kBins, 0);
  };

  static std::size_t at(Whole index) { return static_cast<std::size_t>(index); }
  static Whole around(Whole sector) { return (sector + kSectors) % kSectors; }
  [[nodiscard]] Whole of_bin(Whole of_1024_mm) const { return of_1024_mm * bin_mm_ / 1024; }

  [[nodiscard]] Whole height_over_row(const std::vector<Whole>& its, Whole along_mm,
                                      Whole z_mm) const {
    const Whole bin = std::min(along_mm / bin_mm_, kBins - 1);
    const Whole part = std::min<Whole>(along_mm - bin * bin_mm_, 16'384);
    const Whole rise = its[at(bin + 1)] - its[at(bin)];
    // A part of a bin is less than one of them, but behind the last one.
    return z_mm - its[at(bin)] - floor_of(rise * part, bin_mm_);
  }

  [[nodiscard]] bool has_returns(Whole sector) const {
    const auto row = std::span(lowest_).subspan(at(sector * kBins), at(kBins));
    return std::ranges::any_of(row, [](const auto& low) { return low.has_value(); });
  }

  [[nodiscard]] Whole most_plausible(Whole bin) const {
    const Whole rise = of_bin(rule_.plausible_rise) * (bin + 1);
    return std::min(rule_.plausible + rise, rule_.most_plausible);
  }

  [[nodiscard]] std::optional<Whole> plausible_low(Whole sector, Whole bin) const {
    const std::optional<Whole>& low = lowest_[at(around(sector) * kBins + bin)];
    return low && *low <= most_plausible(bin) ? low : std::nullopt;
  }

  // The lowest return of a bin, if it is believed: it is no mirror image.
  [[nodiscard]] std::optional<Whole> low(Whole sector, Whole bin) const {
    const std::optional<Whole> its = plausible_low(sector, bin);
    const std::optional<Whole> left = plausible_low(sector - rule_.mirrored_sectors, bin);
    const std::optional<Whole> right = plausible_low(sector + rule_.mirrored_sectors, bin);
    const bool is_deep =
        its && left && right && *its < std::min({*left, *right, Whole{0}}) - rule_.mirrored;
    return is_deep ? std::nullopt : its;
  }

  [[nodiscard]] Whole expected(const Walker& its, Whole bin) const {
    return its.height + its.slope * std::min(bin - its.bin, rule_.reach);
  }
  [[nodiscard]] Whole most_over(Whole sector, Whole bin) const {
    const Walker& its = walkers_[at(sector)];
    const Whole gap = bin - its.bin;
    if (its.bin >= 0) {
      const Whole widest = its.proofs_missing > 0 ? rule_.doubtful_widest : rule_.widest;
      return std::min(rule_.step + of_bin(rule_.step_rise) * gap, widest);
    }
    const Whole over_last = last_turn(sector, bin) + rule_.over_last;
    const Whole steep = rule_.start + of_bin(rule_.steep_start_rise) * gap;
    const Whole most =
        std::max(rule_.start + of_bin(rule_.start_rise) * gap, std::min(steep, over_last));
    // The higher of two known heights, or the middle one of three.
    std::vector<Whole> known;
    for (const Whole distance : {-rule_.apart, Whole{0}, rule_.apart}) {
      if (const Whole height = last_turn(around(sector + distance), bin); height != 0) {
        known.push_back(height);
      }
    }
    std::ranges::sort(known);
    return known.size() < 2 ? most
                            : std::min(most, std::max<Whole>(known[1], 0) + rule_.over_apart);
  }

  // How high the last turn's surface is in the middle of a bin.
  [[nodiscard]] Whole last_turn(Whole sector, Whole bin) const {
    const std::vector<Whole>& its = rows_[at(sector)];
    return floor_of(its[at(bin)] + its[at(bin + 1)], 2);
  }

  void walk() {
    walkers_.assign(kSectors, {});
    for (Whole bin = 0; bin < kBins; ++bin) {
      // By itself.
      Ring own(kSectors);
      for (Whole sector = 0; sector < kSectors; ++sector) {
        const std::optional<Whole> its = low(sector, bin);
        const Walker& walker = walkers_[at(sector)];
        if (its && *its - expected(walker, bin) <= most_over(sector, bin)) {
          own[at(sector)] = its;
        }
      }
      // All of them before anybody moves on.
      Ring ground = own;
      for (Whole sector = 0; sector < kSectors; ++sector) {
        if (!own[at(sector)]) {
          ground[at(sector)] = beside(sector, bin, own);
        }
      }
      for (Whole sector = 0; sector < kSectors; ++sector) {
        if (const std::optional<Whole>& height = ground[at(sector)]) {
          move_on(sector, bin, *height, own[at(sector)].has_value());
        }
      }
    }
    for (Walker& walker : walkers_) {
      for (Whole bin = walker.bin + 1; bin < kBins; ++bin) {
        walker.ground[at(bin)] = expected(walker, bin);
      }
    }
  }

  // The ground of a sector that has none by itself.
  [[nodiscard]] std::optional<Whole> beside(Whole sector, Whole bin, const Ring& own) const {
    std::vector<Whole> found;
    for (const Whole direction : {1, -1}) {
      for (Whole distance = 1; distance <= rule_.across; ++distance) {
        if (const auto& its = own[at(around(sector + direction * distance))]) {
          found.push_back(*its);
          break;
        }
      }
    }
    if (found.empty()) {
      return std::nullopt;
    }
    const std::optional<Whole> its = low(sector, bin);
    if (its && *its <= std::max(found.front(), found.back()) + rule_.beside) {
      return its;
    }
    const Whole mean = floor_of(found.front() + found.back(), 2);
    const Whole off = mean - expected(walkers_[at(sector)], bin);
    const Whole most = std::max(most_over(sector, bin), rule_.widest);
    return off <= most && off >= -most ? std::optional(mean) : std::nullopt;
  }

  void move_on(Whole sector, Whole bin, Whole height, bool is_own) {
    Walker& walker = walkers_[at(sector)];
    const Whole gap = bin - walker.bin;
    const Whole inverse = 65'536 / gap;
    const Whole off = height - expected(walker, bin);
    if (is_own && off >= -most_over(sector, bin)) {
      const Whole steepest = of_bin(rule_.steepest);
      walker.slope = std::clamp(walker.slope + floor_of(off * inverse, 65'536 * rule_.slope_parts),
                                -steepest, steepest);
    }
    const Whole rise = height - walker.height;
    for (Whole i = 1; i <= gap; ++i) {
      walker.ground[at(walker.bin + i)] =
          i == gap ? height : walker.height + floor_of(rise * inverse * i, 65'536);
    }
    if (walker.bin < 0) {
      const bool is_doubtful = bin >= rule_.near_starts && height > rule_.high_start;
      walker.proofs_missing = is_doubtful ? rule_.proofs : 0;
    } else if (is_own) {
      --walker.proofs_missing;
    }
    walker.height = height;
    walker.bin = bin;
  }

  [[nodiscard]] Whole middle(Whole sector, Whole bin) const {
    std::vector<Whole> three;
    for (const Whole other : {sector - 1, sector, sector + 1}) {
      three.push_back(walkers_[at(around(other))].ground[at(bin)]);
    }
    std::ranges::sort(three);
    return three[1];
  }

  [[nodiscard]] std::vector<Whole> row_of(Whole sector) const {
    const auto mean = [&](Whole bin) {
      return floor_of(middle(sector, bin - 1) + middle(sector, bin), 2);
    };
    std::vector<Whole> row{0};
    for (Whole bin = 1; bin < kBins; ++bin) {
      row.push_back(mean(bin));
    }
    const Whole last = middle(sector, kBins - 1);
    const Whole end = last + floor_of(last - middle(sector, kBins - 2), 2);
    row.push_back(std::clamp<Whole>(end, -32'000, 32'000));
    for (Whole bin = 0; bin < kBins; ++bin) {
      if (const std::optional<Whole> its = low(sector, bin)) {
        row[at(bin)] = std::min(row[at(bin)], *its + rule_.over_lowest);
        row[at(bin + 1)] = std::min(row[at(bin + 1)], *its + rule_.over_lowest);
      }
    }
    return row;
  }

  Whole bin_mm_;
  GroundRule rule_;
  Ring lowest_ = Ring(at(kSectors * kBins));  // bin after bin of one sector, and then of the next
  std::vector<Walker> walkers_;
  std::vector<std::vector<Whole>> rows_;
  std::vector<std::optional<Whole>> kept_;
};

}  // namespace iog::tests
