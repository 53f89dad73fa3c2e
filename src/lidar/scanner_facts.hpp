// The properties of a scanner, as defined by the decoder of its format.
#pragma once

#include <cstddef>
#include <cstdint>
#include <type_traits>

#include "lidar/formats.hpp"

namespace iog::lidar {

struct ScannerFacts {
  std::size_t layers = 0;  // 0 if the packets do not determine it
  std::uint32_t ticks_per_turn = 0;
  bool turns = false;
  bool has_elevations = false;  // the format defines the elevations; otherwise they vary by unit
  bool has_modes = false;       // packets do not contain the rotation speed of the unit
  bool has_beam_tilt = false;   // the mirror of the unit is tilted
  bool is_points = false;       // points contain directions; the car file contains layer elevations
  bool is_radar = false;        // it reports objects but no free space
  bool is_ultrasonic = false;   // it reports the distance of the nearest object in a cone

  // Returns true if the sensor's detections have no precise direction.
  [[nodiscard]] constexpr bool marks_arcs() const { return is_radar || is_ultrasonic; }
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

template <typename Decoder>
concept IsPoints = requires {
  Decoder::kIsPoints;
};

template <typename Decoder>
concept IsRadar = requires {
  Decoder::kIsRadar;
};

template <typename Decoder>
concept IsUltrasonic = requires {
  Decoder::kIsUltrasonic;
};

template <typename Decoder>
constexpr std::size_t layers_of() {
  if constexpr (HasOneLayerCount<Decoder>) {
    return Decoder::kLayers;
  } else {
    return Decoder::kElevationsDeg.size();
  }
}

constexpr ScannerFacts facts_of(Format format) {
  ScannerFacts facts;
  with_decoder(format, [&]<typename Decoder>(std::type_identity<Decoder> /*which*/) {
    facts = {.layers = layers_of<Decoder>(),
             .ticks_per_turn = Decoder::kTicksPerTurn,
             .turns = Decoder::kTurns,
             .has_elevations = !Decoder::kElevationsDeg.empty(),
             .has_modes = HasModes<Decoder>,
             .has_beam_tilt = HasBeamTilt<Decoder>,
             .is_points = IsPoints<Decoder>,
             .is_radar = IsRadar<Decoder>,
             .is_ultrasonic = IsUltrasonic<Decoder>};
  });
  return facts;
}

constexpr bool can_have_layers(Format format, std::size_t layers) {
  bool can = false;
  with_decoder(format, [&]<typename Decoder>(std::type_identity<Decoder> /*which*/) {
    if constexpr (HasSeveralLayerCounts<Decoder>) {
      can = Decoder::can_have_layers(layers);
    } else {
      can = layers == layers_of<Decoder>();
    }
  });
  return can;
}

// Returns the number of points per packet for a unit with `layers` layers. For a LUX, returns the
// number of points per azimuth.
constexpr std::size_t points_of_packet(Format format, std::size_t layers) {
  std::size_t points = 0;
  with_decoder(format, [&]<typename Decoder>(std::type_identity<Decoder> /*which*/) {
    points = Decoder::points_of_packet(layers);
  });
  return points;
}

}  // namespace iog::lidar
