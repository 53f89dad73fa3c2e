// Limits on the values of a car. The loops in the target's code rely on these limits. The limits
// apply to the integers that a car file is compiled into. The target checks the car block in its
// image, and the PC checks car files.
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
// The maximum range of an ultrasonic sensor. The range is limited because the cells of a cone are
// visited one by one (grid/cone.hpp).
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

// The maximum magnitude of coordinates. This limit keeps products of subcells within 64 bits.
inline constexpr std::int32_t kFarthestM = 1000;
// The largest cell size at which `moved` can distinguish moving objects from flickering edges.
inline constexpr std::uint16_t kCoarsestMovedMm = 200;
inline constexpr std::string_view kHalfLifeWords = "0.05 ... 600";
inline constexpr std::string_view kMassWords = "0.05 ... 0.99";
inline constexpr std::string_view kAccumulationWords =
    "with slowest_m_s an object that passes in 0.1 ... 60 s";

// The maximum distance of a sensor from the car's footprint. The distance allows for bumpers and
// roof racks.
inline constexpr std::int32_t kOffCarMm = 150;

// Converts a length to subcells, rounded up. Requires length_mm <= kLongestRangeMm.
constexpr std::uint64_t subcells_up(std::uint32_t length_mm, const geometry::Grid& grid) {
  return (std::uint64_t{length_mm} * geometry::kResolution + grid.cell_mm - 1) / grid.cell_mm;
}

// Returns the maximum length of a beam. The beams of a tilted mirror are approximated
// (tools/car/tilted_mirror.hpp). At azimuths that the mirror cannot reach, an approximated beam may
// be longer than the unit's range. Requires range_mm <= kLongestRangeMm.
constexpr std::uint32_t longest_line_mm(lidar::Format format, std::uint32_t range_mm) {
  return lidar::facts_of(format).has_beam_tilt ? range_mm + range_mm / 64 + 1 : range_mm;
}

// Checks names, numbers, addresses and ports. Both check functions identify a faulty field by its
// name in the car file. check_numbers() does not need the tables. Call it before check_tables().
// Each sensor's range must be above 0.
void check_numbers(const vehicle::Vehicle& car, const net::Config& network,
                   const vehicle::Tell& tell);

// Checks the tables of a car that has passed check_numbers().
void check_tables(const vehicle::Vehicle& car, const vehicle::Tell& tell);

// Returns the first fault. The result's `field` is empty if the car is valid. `network` is the
// network configuration in the same block.
[[nodiscard]] vehicle::Fault fault_of(const vehicle::Vehicle& car, const net::Config& network);

}  // namespace iog::car_block
