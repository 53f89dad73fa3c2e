// Every wire format and its decoder, in one place.
//
// A decoder has kName, kTicksPerTurn, kTurns, kElevationsDeg (empty if they are each unit's own),
// decode(), info(), move_to() and for_each_point(), as lidar/ibeo_lux.hpp has them
// (docs/sensors.md).
#pragma once

#include <type_traits>
#include <variant>

#include "lidar/hesai.hpp"
#include "lidar/ibeo_lux.hpp"
#include "lidar/ibeo_lux8.hpp"
#include "lidar/ouster.hpp"
#include "lidar/scan_point.hpp"
#include "lidar/velodyne_hdl32e.hpp"
#include "lidar/velodyne_hdl64e.hpp"
#include "lidar/velodyne_vlp16.hpp"
#include "lidar/velodyne_vlp32c.hpp"

namespace iog::lidar {

// The wire formats that are understood (docs/spec.md).
enum class Format : std::uint8_t {
  kHesaiPandar64,     // data packets of 1194 or 1198 bytes
  kHesaiXt32,         // PandarXT-32, data packets of 1080 bytes
  kIbeoLux,           // 0x2202 messages
  kIbeoLux8,          // the same, of a tilted mirror
  kOusterLegacy,      // OS, the profile before firmware 2.0
  kOusterRng15,       // OS, low data rate
  kOusterRng19,       // OS, single return
  kVelodyneHdl32e,    // data packets of 1206 bytes, as all of Velodyne's
  kVelodyneHdl64eS2,  // in two banks
  kVelodyneHdl64eS3,
  kVelodyneVlp16,
  kVelodyneVlp32c,
};

using AnyDecoder = std::variant<HesaiPandar64,     //
                                HesaiXt32,         //
                                IbeoLux,           //
                                IbeoLux8,          //
                                OusterLegacy,      //
                                OusterRng15,       //
                                OusterRng19,       //
                                VelodyneHdl32e,    //
                                VelodyneHdl64eS2,  //
                                VelodyneHdl64eS3,  //
                                VelodyneVlp16,     //
                                VelodyneVlp32c>;

// Calls visit(std::type_identity<Decoder>()) with the decoder of the format. Without a default: a
// format that is missing here does not compile. What is no format at all is not visited.
template <typename Visit>
constexpr void with_decoder(Format format, Visit&& visit) {
  switch (format) {
    case Format::kHesaiPandar64:
      return visit(std::type_identity<HesaiPandar64>());
    case Format::kHesaiXt32:
      return visit(std::type_identity<HesaiXt32>());
    case Format::kIbeoLux:
      return visit(std::type_identity<IbeoLux>());
    case Format::kIbeoLux8:
      return visit(std::type_identity<IbeoLux8>());
    case Format::kOusterLegacy:
      return visit(std::type_identity<OusterLegacy>());
    case Format::kOusterRng15:
      return visit(std::type_identity<OusterRng15>());
    case Format::kOusterRng19:
      return visit(std::type_identity<OusterRng19>());
    case Format::kVelodyneHdl32e:
      return visit(std::type_identity<VelodyneHdl32e>());
    case Format::kVelodyneHdl64eS2:
      return visit(std::type_identity<VelodyneHdl64eS2>());
    case Format::kVelodyneHdl64eS3:
      return visit(std::type_identity<VelodyneHdl64eS3>());
    case Format::kVelodyneVlp16:
      return visit(std::type_identity<VelodyneVlp16>());
    case Format::kVelodyneVlp32c:
      return visit(std::type_identity<VelodyneVlp32c>());
  }
}

// "Velodyne VLP-16"
[[nodiscard]] constexpr std::string_view name_of(Format format) {
  std::string_view name;
  with_decoder(format, [&]<typename Decoder>(std::type_identity<Decoder> /*which*/) {
    name = Decoder::kName;
  });
  return name;
}

// Whether its scans are turns of a head.
[[nodiscard]] constexpr bool turns(Format format) {
  bool it_does = false;
  with_decoder(format, [&]<typename Decoder>(std::type_identity<Decoder> /*which*/) {
    it_does = Decoder::kTurns;
  });
  return it_does;
}

[[nodiscard]] constexpr std::int32_t ticks_per_turn(Format format) {
  std::int32_t ticks = 0;
  with_decoder(format, [&]<typename Decoder>(std::type_identity<Decoder> /*which*/) {
    ticks = Decoder::kTicksPerTurn;
  });
  return ticks;
}

}  // namespace iog::lidar
