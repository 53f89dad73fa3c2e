// Defines the height limits for the beams and returns of level rotating lidars. Beams free cells
// and returns mark cells only within these limits. The limits are either the vehicle's height band
// or heights relative to the ground (docs/ground.md). A judge applies the limits to the points of a
// packet, and a gate applies them to the beams of a line. The judge is selected once per packet,
// and the gate is selected once per line.
#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>

#include "grid/beam_lines.hpp"
#include "grid/line_part.hpp"
#include "grid/turn_lines.hpp"
#include "ground/ground.hpp"
#include "vehicle/beam.hpp"
#include "vehicle/vehicle.hpp"

namespace iog::grid {

struct BandJudge {
  // Returns the argument `height_at` of vehicle::classify() for a return at this distance along the
  // line of an azimuth step. It also sets `is_tall`, which is valid only for an obstacle.
  // Referenced objects must outlive it.
  [[nodiscard]] static auto height_at(const TurnLayers& layers, std::uint32_t /*step*/,
                                      std::size_t layer, std::uint32_t along_mm, bool& is_tall) {
    // The lambda is inlined because a function call costs about 40 instructions per point.
    return [&layers, layer, along_mm, &is_tall ](std::uint32_t reach_mm)
        __attribute__((always_inline)) {
      const vehicle::Ranges& in_band = layers.layers[layer].in_band;
      const bool ends_in_band = in_band.contain(reach_mm);
      is_tall = ends_in_band && layers.tall[layer].contain(along_mm);
      return vehicle::Height{
          .fate = ends_in_band ? vehicle::Fate::kUsed : vehicle::Fate::kOutsideHeightBand,
          .is_whole = ends_in_band && in_band.first == 0};
    };
  }
  // `behind_mm()` and `rank()` return the members of TurnLayer with the same names.
  [[nodiscard]] static std::uint32_t behind_mm(const TurnLayers& layers, std::uint32_t /*step*/,
                                               std::size_t layer) {
    return layers.layers[layer].behind_mm;
  }
  [[nodiscard]] static std::uint32_t rank(const TurnLayers& layers, std::uint32_t /*step*/,
                                          std::size_t layer) {
    return layers.layers[layer].rank;
  }
};

// With a ground estimate, each layer has its own limits in each sector.
struct GroundJudge {
  const ground::Beams* beams;
  const ground::Exits* exits;
  ground::PacketJudge judge;

  [[nodiscard]] auto height_at(const TurnLayers& /*layers*/, std::uint32_t step, std::size_t layer,
                               std::uint32_t along_mm, bool& is_tall) const {
    return [ this, step, layer, along_mm, &is_tall ](std::uint32_t reach_mm)
        __attribute__((always_inline)) {
      const std::uint32_t sector = beams->sector_of(step);
      const std::int32_t z_mm = beams->height_mm(beams->slope(layer), along_mm);
      const auto judged = judge.judge(sector, along_mm, z_mm);
      is_tall = judged.is_tall;
      return vehicle::Height{.fate = judged.fate,
                             .is_whole = reach_mm <= exits->to_mm(sector, layer)};
    };
  }
  [[nodiscard]] std::uint32_t behind_mm(const TurnLayers& layers, std::uint32_t step,
                                        std::size_t layer) const {
    return exits->to_mm(beams->sector_of(step), layer) + layers.zones_mm;
  }
  [[nodiscard]] std::uint32_t rank(const TurnLayers& /*layers*/, std::uint32_t step,
                                   std::size_t layer) const {
    return exits->rank_of(beams->sector_of(step), layer);
  }
};

class BandGate {
 public:
  // Both arguments must outlive the gate.
  BandGate(const KeptLine& line, const TurnLayers& layers) : line_(&line), layers_(&layers) {}

  // Returns the layer with the given rank. The layer with rank 0 is the one that stays within the
  // limits for the longest distance.
  [[nodiscard]] std::size_t layer_of(std::uint32_t rank) const { return layers_->by_rank[rank]; }
  // A beam whose hit is at or beyond far_mm() frees every cell that any layer of rank
  // TurnLayers::near_rank or higher can free.
  [[nodiscard]] std::uint32_t far_mm() const { return layers_->far_mm; }
  // `part()` returns the part of the line that the layer can free. `end()` returns the end of this
  // part. Use it only if the part is not empty.
  [[nodiscard]] FreePart part(std::size_t layer) const {
    const BandLimits& band = layers_->layers[layer].band;
    return {line_->in_band(band), band.is_free_before_mm()};
  }
  [[nodiscard]] Between end(std::size_t layer) const {
    return line_->end_in_band(layers_->layers[layer].band);
  }
  // `low_part()` returns the part of the line in which the layer's beam is low. `may_be_low()`
  // returns false if this part cannot begin before a hit at the given range.
  [[nodiscard]] LinePart low_part(std::size_t layer) const {
    return line_->in_band(layers_->low[layer]);
  }
  [[nodiscard]] static bool may_be_low(std::size_t /*layer*/, std::uint32_t /*hit_mm*/) {
    return true;
  }

 private:
  const KeptLine* line_;
  const TurnLayers* layers_;
};

// Limits the beams of a line by their height above the estimated ground. In every sector, the beams
// of all layers start within the limits.
class GroundGate {
 public:
  // All arguments must outlive the gate. The line must lie in this sector.
  GroundGate(const KeptLine& line, const vehicle::Sensor& sensor, const TurnLayers& layers,
             const ground::Ground& ground, std::uint32_t sector)
      : line_(&line), sensor_(&sensor), layers_(&layers), ground_(&ground), sector_(sector) {}

  [[nodiscard]] std::size_t layer_of(std::uint32_t rank) const {
    return ground_->exits().by_rank(sector_, rank);
  }
  [[nodiscard]] std::uint32_t far_mm() const {
    return to_mm(layer_of(layers_->near_rank)) + layers_->zones_mm;
  }
  [[nodiscard]] FreePart part(std::size_t layer) const {
    return {{line_->in_grid().first, end(layer)}, to_mm(layer) + layers_->zones_mm};
  }
  [[nodiscard]] Between end(std::size_t layer) const {
    return line_->end_at(*sensor_, to_mm(layer));
  }
  [[nodiscard]] LinePart low_part(std::size_t layer) const {
    const ground::Ground::Stretch low = ground_->low_stretch(sector_, layer);
    return line_->part_between(*sensor_, low.from_mm, low.to_mm);
  }
  // This check saves time, because most hits are nearer than the range at which their beams become
  // low.
  [[nodiscard]] bool may_be_low(std::size_t layer, std::uint32_t hit_mm) const {
    return ground_->low_from_mm(sector_, layer) < hit_mm;
  }

 private:
  [[nodiscard]] std::uint32_t to_mm(std::size_t layer) const {
    return ground_->exits().to_mm(sector_, layer);
  }

  const KeptLine* line_;
  const vehicle::Sensor* sensor_;
  const TurnLayers* layers_;
  const ground::Ground* ground_;
  std::uint32_t sector_;
};

}  // namespace iog::grid
