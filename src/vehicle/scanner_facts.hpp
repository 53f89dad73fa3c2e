// What a scanner's format decides, and what follows from it and a description.
#pragma once

#include <cstddef>
#include <cstdint>
#include <string_view>
#include <type_traits>

#include "geometry/grid.hpp"
#include "lidar/formats.hpp"
#include "numeric/elementary.hpp"
#include "sensor_model/profile.hpp"
#include "vehicle/description.hpp"

namespace iog::vehicle {

// Of the steps of a turn that a description may ask for.
inline constexpr std::uint32_t kFewestAzimuthSteps = 256;
inline constexpr std::uint32_t kMostAzimuthSteps = 16384;

// Of the recursive set. Smaller ones have more indexes than a cell can hold.
inline constexpr double kLeastEpsilon = 0.01;
inline constexpr double kMostEpsilon = 0.4;

struct ScannerFacts {
  std::size_t layers = 0;
  std::uint32_t ticks_per_turn = 0;
  bool turns = false;
  bool has_elevations = false;  // of its format; else they are each unit's own
  bool has_modes = false;       // its packets do not say how fast it turns
  bool has_beam_tilt = false;   // its mirror is tilted
};

template <typename Decoder>
concept HasSeveralLayerCounts = requires {
  Decoder::can_have_layers(std::size_t{});
};

template <typename Decoder>
concept HasOneLayerCount = requires {
  Decoder::kLayers;
};

template <typename Decoder>
concept HasModes = requires {
  Decoder::kHasModes;
};

template <typename Decoder>
concept HasBeamTilt = requires {
  Decoder::kHasBeamTilt;
};

// None of a format whose packets leave open how many there are.
template <typename Decoder>
constexpr std::size_t layers_of() {
  if constexpr (HasOneLayerCount<Decoder>) {
    return Decoder::kLayers;
  } else {
    return Decoder::kElevationsDeg.size();
  }
}

constexpr bool can_have_layers(lidar::Format format, std::size_t layers) {
  bool can = false;
  lidar::with_decoder(format, [&]<typename Decoder>(std::type_identity<Decoder> /*which*/) {
    if constexpr (HasSeveralLayerCounts<Decoder>) {
      can = Decoder::can_have_layers(layers);
    } else {
      can = layers == layers_of<Decoder>();
    }
  });
  return can;
}

constexpr ScannerFacts facts_of(lidar::Format format) {
  ScannerFacts facts;
  lidar::with_decoder(format, [&]<typename Decoder>(std::type_identity<Decoder> /*which*/) {
    facts = {.layers = layers_of<Decoder>(),
             .ticks_per_turn = Decoder::kTicksPerTurn,
             .turns = Decoder::kTurns,
             .has_elevations = Decoder::kElevationsDeg.size() != 0,
             .has_modes = HasModes<Decoder>,
             .has_beam_tilt = HasBeamTilt<Decoder>};
  });
  return facts;
}

// The points of one packet, of a LUX those of one direction: a limit below it lets nothing pass.
// layers: of the unit.
constexpr std::size_t fewest_points(lidar::Format format, std::size_t layers) {
  std::size_t points = 0;
  lidar::with_decoder(format, [&]<typename Decoder>(std::type_identity<Decoder> /*which*/) {
    if constexpr (std::is_base_of_v<lidar::VelodynePacket, Decoder>) {
      points = Decoder::kPointsPerPacket;
    } else if constexpr (std::is_base_of_v<lidar::HesaiPacket, Decoder>) {
      points = std::size_t{Decoder::unit().blocks} * Decoder::unit().lasers;
    } else if constexpr (std::is_base_of_v<lidar::OusterPacket, Decoder>) {
      points = Decoder::kColumns * layers;
    } else {
      points = lidar::IbeoLux::kElevationsDeg.size() * lidar::IbeoLux::kMaxEchoes;
    }
  });
  return points;
}
inline constexpr std::string_view kFewestPointsWords =
    "at least the points of a packet: 384 of a Velodyne or Pandar64, 256 of an XT-32, 16 a row of "
    "an Ouster, and of a LUX 12 a direction: layers, directions and echoes multiplied";

// The fewest steps of a turn, in powers of two, that are at most a cell wide at this range: step
// times range over 2 is half a cell or less.
constexpr std::uint32_t default_steps(std::uint32_t range_mm) {
  std::uint32_t steps = kFewestAzimuthSteps;
  while (steps < kMostAzimuthSteps &&
         2 * numeric::kPi * range_mm > steps * double{geometry::kCellMm}) {
    steps *= 2;
  }
  return steps;
}

// Of a sensor that turns.
constexpr std::uint32_t steps_of(const SensorConfig& config) {
  return config.azimuth_steps_per_turn != 0 ? config.azimuth_steps_per_turn
                                            : default_steps(config.range_max_mm);
}

constexpr double radians(double degrees) { return degrees * numeric::kPi / 180; }

constexpr double tangent(double elevation) {
  return numeric::sin(elevation) / numeric::cos(elevation);
}

// What a laser's calibration adds to each range: a beam that starts so high across itself is, seen
// from the side, one from the unit's axis. It starts height / cos over the origin, and each of its
// ranges is height * tan less.
constexpr double horizontal_range_m(const lidar::Laser& laser) {
  return laser.range_m - laser.height_m * tangent(radians(laser.elevation_deg));
}

constexpr sensor_model::ProfileConfig profile_config(const Description& car,
                                                     const SensorConfig& config) {
  return {.sigma_m = config.sigma_m,
          .cell_length_m = config.precision_mm / 1000.0,
          .epsilon = car.epsilon,
          .quantisation = car.quantisation};
}

}  // namespace iog::vehicle
