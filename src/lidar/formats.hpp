// Lists all wire formats and their decoders.
//
// A decoder has kName, kDataSheet, kTicksPerTurn, kTurns, kElevationsDeg (empty if the elevations
// differ between units), points_of_packet(), decode(), info(), move_to() and for_each_point(). See
// lidar/ibeo_lux.hpp for an example. CONTRIBUTING.md describes how to add a format.
#pragma once

#include <cstddef>
#include <cstdint>
#include <string_view>
#include <type_traits>
#include <utility>
#include <variant>

#include "lidar/continental_ars548.hpp"
#include "lidar/hesai_pandar40p.hpp"
#include "lidar/hesai_pandar64.hpp"
#include "lidar/hesai_qt128.hpp"
#include "lidar/hesai_qt64.hpp"
#include "lidar/hesai_xt.hpp"
#include "lidar/ibeo_lux.hpp"
#include "lidar/ibeo_lux8.hpp"
#include "lidar/mavlink_ultrasonic.hpp"
#include "lidar/ouster.hpp"
#include "lidar/points.hpp"
#include "lidar/velodyne_hdl32e.hpp"
#include "lidar/velodyne_hdl64e.hpp"
#include "lidar/velodyne_puck_hires.hpp"
#include "lidar/velodyne_vlp16.hpp"
#include "lidar/velodyne_vlp32c.hpp"
#include "lidar/velodyne_vls128.hpp"

namespace iog::lidar {

// The supported wire formats (docs/spec.md). All other lists of formats are derived from this list.
using AnyDecoder = std::variant<ContinentalArs548,  //
                                HesaiPandar40p,     //
                                HesaiPandar64,      //
                                HesaiQt64,          //
                                HesaiQt128,         //
                                HesaiXt16,          //
                                HesaiXt32,          //
                                HesaiXt32m,         //
                                IbeoLux,            //
                                IbeoLux8,           //
                                MavlinkUltrasonic,  //
                                OusterLegacy,       //
                                OusterRng15,        //
                                OusterRng19,        //
                                OusterRng19Dual,    //
                                Points,             //
                                PointsTurning,      //
                                VelodyneHdl32e,     //
                                VelodyneHdl64eS2,   //
                                VelodyneHdl64eS3,   //
                                VelodynePuckHires,  //
                                VelodyneVlp16,      //
                                VelodyneVlp32c,     //
                                VelodyneVls128>;

inline constexpr std::size_t kFormatCount = std::variant_size_v<AnyDecoder>;

// A wire format, given by its index in AnyDecoder.
enum class Format : std::uint8_t {};

namespace formats_detail {

template <typename Decoder, typename... All>
consteval std::size_t place_in(std::type_identity<std::variant<All...>> /*list*/) {
  static_assert((std::is_same_v<Decoder, All> || ...), "a decoder of the list");
  std::size_t place = 0;
  static_cast<void>(((std::is_same_v<Decoder, All> || (++place, false)) || ...));
  return place;
}

template <std::size_t... kPlace>
constexpr void visit_place(std::size_t place, auto&& visit,
                           std::index_sequence<kPlace...> /*places*/) {
  static_cast<void>(
      ((place == kPlace &&
        (visit(std::type_identity<std::variant_alternative_t<kPlace, AnyDecoder>>()), true)) ||
       ...));
}

}  // namespace formats_detail

template <typename Decoder>
inline constexpr auto kFormat =
    static_cast<Format>(formats_detail::place_in<Decoder>(std::type_identity<AnyDecoder>()));

// Calls visit(std::type_identity<Decoder>()) with the decoder of the format. Does nothing if the
// value is not a valid format.
template <typename Visit>
constexpr void with_decoder(Format format, Visit&& visit) {
  formats_detail::visit_place(static_cast<std::size_t>(format), visit,
                              std::make_index_sequence<kFormatCount>());
}

// Calls visit(format, std::type_identity<Decoder>()) for each format.
template <typename Visit>
constexpr void for_each_format(Visit&& visit) {
  for (std::size_t place = 0; place < kFormatCount; ++place) {
    const auto format = static_cast<Format>(place);
    with_decoder(format, [&](auto decoder) { visit(format, decoder); });
  }
}

// The name of the format, such as "Velodyne VLP-16".
[[nodiscard]] constexpr std::string_view name_of(Format format) {
  std::string_view name;
  with_decoder(format, [&]<typename Decoder>(std::type_identity<Decoder> /*which*/) {
    name = Decoder::kName;
  });
  return name;
}

// Returns true if each scan of this format is one turn of a spinning lidar.
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
