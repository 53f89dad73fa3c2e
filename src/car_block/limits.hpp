// What a car must keep to so that the loops of the target may rely on it, asked of the integers
// that its description has become: by the target of the car of its image, and by the PC of a car's
// file.
#pragma once

#include <cstdint>
#include <string_view>

#include "geometry/grid.hpp"
#include "lidar/scanner_facts.hpp"
#include "net/config.hpp"
#include "vehicle/fault.hpp"
#include "vehicle/vehicle.hpp"

namespace iog::car_block {

inline constexpr std::uint32_t kLongestRangeMm = 130'000;
// Of an ultrasonic unit: the cells of its cone are looked at one by one (grid/cone.hpp).
inline constexpr std::uint32_t kLongestConeMm = 10'000;
inline constexpr std::string_view kRangeWords = "more than range_min_mm, at most 130000";

inline constexpr std::string_view kArcWords =
    "0.1 ... 1 of a radar, 2 ... 20 of an ultrasonic unit, of others none";
inline constexpr std::string_view kLayerWords =
    "elevation_deg alone, each above the one before, -89 ... 89";
inline constexpr std::string_view kGroundLowWords = "0.1 ... 1";
inline constexpr std::string_view kGroundTopWords = "low_m + 0.5 ... 10";
inline constexpr std::string_view kMovedLowWords =
    "0.1 m or more over what is no obstacle, over the ground 0.4 or more, at most 10";
inline constexpr std::string_view kMovedTallWords = "0, or at most where obstacles end";

// Coordinates stay within this, so that products of subcells stay within 64 bits.
inline constexpr std::int32_t kFarthestM = 1000;

// How far a sensor may stand off its car: a bumper, a roof rack.
inline constexpr std::int32_t kOffCarMm = 150;

// A length in subcells, rounded up. length_mm <= kLongestRangeMm.
constexpr std::uint64_t subcells_up(std::uint32_t length_mm) {
  return (std::uint64_t{length_mm} * geometry::kResolution + geometry::kCellMm - 1) /
         geometry::kCellMm;
}

// No end of a beam is farther away: those of a tilted mirror are fitted
// (tools/car/tilted_mirror.hpp), and at azimuths that it cannot see they may lie beyond the
// range. range_mm <= kLongestRangeMm.
constexpr std::uint32_t longest_line_mm(lidar::Format format, std::uint32_t range_mm) {
  return lidar::facts_of(format).has_beam_tilt ? range_mm + range_mm / 64 + 1 : range_mm;
}

// Each tells what it finds by the field of a car's file. First what needs no tables: names,
// numbers, addresses and ports. Sensors have a range above 0.
void check_numbers(const vehicle::Vehicle& car, const net::Config& network,
                   const vehicle::Tell& tell);

// Then the tables of a car whose numbers are sound.
void check_tables(const vehicle::Vehicle& car, const vehicle::Tell& tell);

// The first fault of all; one without a field: none. network is that of the same block.
[[nodiscard]] vehicle::Fault fault_of(const vehicle::Vehicle& car, const net::Config& network);

}  // namespace iog::car_block
