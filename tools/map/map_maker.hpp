// A map of a source to the block for the target.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "tools/map/geo_map.hpp"
#include "tools/poses/map_origin.hpp"

namespace iog::tools {

struct MapOptions {
  std::optional<MapOrigin> origin{};           // else the middle of the data
  std::optional<GeoBox> box{};                 // what is wanted: this,
  std::optional<double> radius_m{};            // or so far around the origin, else all of the data
  std::optional<std::uint32_t> accuracy_mm{};  // else kOsmAccuracyMm or kSurveyedAccuracyMm
  std::string attribution{};                   // else that of the source
};

inline constexpr std::uint32_t kOsmAccuracyMm = 500;
inline constexpr std::uint32_t kSurveyedAccuracyMm = 100;

// The belief in a source, of 256: 0.97 and 0.99.
inline constexpr std::uint8_t kOsmBelief = 248;
inline constexpr std::uint8_t kSurveyedBelief = 253;

// The middle of the data, where a plane touches the earth that nobody has placed. UsageError if
// there are no places in it.
[[nodiscard]] MapOrigin middle_of(const GeoMap& map);

struct MadeMap {
  std::vector<std::uint8_t> block;
  std::string remark;  // empty, or what the user should know of the extent
};

// Counts in the map's census what becomes of it. UsageError if there is nothing to make a block of,
// or if it does not fit.
[[nodiscard]] MadeMap make_block(GeoMap& map, const MapOptions& options);

// UsageError if the block has nothing in it: it would say of all its extent that there is neither a
// building nor a road. map: of which it was made.
void demand_features(const GeoMap& map, const MadeMap& made);

}  // namespace iog::tools
