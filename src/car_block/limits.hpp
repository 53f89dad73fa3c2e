// The limits of a car, on which the loops of the target rely. They are checked on the integers made
// from the car file: on the target for the car in its image, on the PC for a car file.
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
// For ultrasonic units: the cells of a cone are visited one by one (grid/cone.hpp).
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

// Limit of coordinates, which keeps products of subcells within 64 bits.
inline constexpr std::int32_t kFarthestM = 1000;

// The maximum distance of a sensor from its car's footprint, for bumpers and roof racks.
inline constexpr std::int32_t kOffCarMm = 150;

// A length in subcells, rounded up. length_mm <= kLongestRangeMm.
constexpr std::uint64_t subcells_up(std::uint32_t length_mm) {
  return (std::uint64_t{length_mm} * geometry::kResolution + geometry::kCellMm - 1) /
         geometry::kCellMm;
}

// The maximum length of a beam. Beams of a tilted mirror are fitted (tools/car/tilted_mirror.hpp);
// at azimuths that the mirror cannot see they may end beyond the range. range_mm <=
// kLongestRangeMm.
constexpr std::uint32_t longest_line_mm(lidar::Format format, std::uint32_t range_mm) {
  return lidar::facts_of(format).has_beam_tilt ? range_mm + range_mm / 64 + 1 : range_mm;
}

// Both functions report faults by the field of the car file. This one runs first and needs no
// tables: it checks names, numbers, addresses and ports. Each sensor's range must be above 0.
void check_numbers(const vehicle::Vehicle& car, const net::Config& network,
                   const vehicle::Tell& tell);

// Checks the tables of a car that has passed check_numbers().
void check_tables(const vehicle::Vehicle& car, const vehicle::Tell& tell);

// The first fault. Its field is empty if there is none. network: from the same block.
[[nodiscard]] vehicle::Fault fault_of(const vehicle::Vehicle& car, const net::Config& network);

}  // namespace iog::car_block
