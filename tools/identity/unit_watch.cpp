#include "tools/identity/unit_watch.hpp"

#include <array>
#include <optional>
#include <string_view>
#include <type_traits>
#include <vector>

#include "intake/packet.hpp"
#include "lidar/formats.hpp"
#include "lidar/scanner_facts.hpp"
#include "tools/identity/foreign_unit.hpp"

namespace iog::tools {
namespace {

using Payload = std::span<const std::byte>;

constexpr std::array<std::size_t, 4> kRows{16, 32, 64, 128};

template <typename Decoder>
SeenUnit sound(const Decoder& decoder, std::string_view name, lidar::FormatSet formats) {
  return {.name = std::string(name),
          .formats = formats,
          .is_sound = true,
          .info = decoder.info(),
          .ticks_per_turn = static_cast<std::uint32_t>(Decoder::kTicksPerTurn),
          .is_numbered = !Decoder::kTurns || std::is_base_of_v<lidar::OusterPacket, Decoder>,
          .turns = Decoder::kTurns};
}

template <typename Decoder>
std::optional<SeenUnit> seen_ouster(Payload payload, lidar::Format format) {
  for (const std::size_t rows : kRows) {
    if (payload.size() != Decoder::packet_bytes(rows)) {
      continue;
    }
    const std::vector<lidar::LaserCorrection> corrections(rows);
    for (const lidar::TurnMode& mode : lidar::kTurnModes) {
      Decoder decoder;
      if (decoder.decode(payload, {.corrections = corrections,
                                   .columns_per_turn = mode.columns_per_turn,
                                   .column_ns = mode.column_ns()}) == lidar::DecodeStatus::kOk) {
        std::string name(Decoder::kName);
        name.append(" ").append(std::to_string(rows));
        return sound(decoder, name, lidar::FormatSet(format));
      }
    }
  }
  return std::nullopt;
}

// Until something is seen, 64 and 128 rows in RNG15 may be 16 and 32 with two returns.
std::optional<SeenUnit> seen_low_rate_ouster(Payload payload) {
  auto seen = seen_ouster<lidar::OusterRng15>(payload, lidar::kFormat<lidar::OusterRng15>);
  constexpr lidar::Format kDual = lidar::kFormat<lidar::OusterRng19Dual>;
  const auto as_dual = seen_ouster<lidar::OusterRng19Dual>(payload, kDual);
  if (seen && as_dual) {
    seen->name += " or " + as_dual->name;
    seen->formats.add(kDual);
    seen->is_in_doubt = true;
  }
  return seen;
}

// Whether they are of what turns, and which layers that has, its car says.
std::optional<SeenUnit> seen_points(Payload payload) {
  constexpr std::array<std::int32_t, 1> kAnyLayer{0};
  lidar::FormatSet formats(lidar::kFormat<lidar::Points>);
  formats.add(lidar::kFormat<lidar::PointsTurning>);
  lidar::Points decoder;
  if (decoder.decode(payload, {.elevations = kAnyLayer}) != lidar::DecodeStatus::kOk) {
    return std::nullopt;
  }
  return sound(decoder, lidar::Points::kName, formats);
}

// As one of the format's. Nothing in the packets of a LUX tells four layers from eight, and a
// Velodyne is not known by a packet alone.
std::optional<SeenUnit> seen_as(lidar::Format format, Payload payload) {
  std::optional<SeenUnit> seen;
  lidar::with_decoder(format, [&]<typename Decoder>(std::type_identity<Decoder> /*which*/) {
    if constexpr (std::is_same_v<lidar::OusterRng15, Decoder>) {
      seen = seen_low_rate_ouster(payload);
    } else if constexpr (std::is_base_of_v<lidar::OusterPacket, Decoder>) {
      seen = seen_ouster<Decoder>(payload, format);
    } else if constexpr (std::is_same_v<lidar::Points, Decoder>) {
      seen = seen_points(payload);
    } else if constexpr (std::is_same_v<lidar::IbeoLux, Decoder> || lidar::IsRadar<Decoder> ||
                         lidar::IsUltrasonic<Decoder> ||
                         std::is_base_of_v<lidar::HesaiPacket, Decoder>) {
      Decoder decoder;
      lidar::FormatSet formats(format);
      if (format == lidar::kFormat<lidar::IbeoLux>) {
        formats.add(lidar::kFormat<lidar::IbeoLux8>);
      }
      if (decoder.decode(payload) == lidar::DecodeStatus::kOk) {
        seen = sound(decoder, Decoder::kName, formats);
      }
    }
  });
  return seen;
}

// "Velodyne HDL-32E or Velodyne VLP-16"
std::string names_of(const lidar::FormatSet& formats) {
  std::string names;
  lidar::for_each_format([&](lidar::Format format, auto /*decoder*/) {
    if (formats.has(format)) {
      names += (names.empty() ? "" : " or ") + std::string(lidar::name_of(format));
    }
  });
  return names;
}

// Of formats that a Velodyne's packet may have.
SeenUnit seen_velodyne(lidar::FormatSet possible, Payload payload) {
  const intake::Packet packet = intake::Packet::decode(possible.first(), payload);
  return {.name = names_of(possible),
          .formats = possible,
          .is_in_doubt = possible != lidar::FormatSet(possible.first()),
          .is_sound = packet.is_sound(),
          .status = packet.status(),
          .info = packet.info(),
          .ticks_per_turn = lidar::VelodynePacket::kTicksPerTurn,
          .turns = true};
}

}  // namespace

SeenUnit UnitWatch::take(Payload payload) {
  const lidar::FormatSet possible = velodyne_.add(payload);
  if (!possible.is_empty()) {
    return seen_velodyne(possible, payload);
  }
  for (unsigned number = 0; number < lidar::kFormatCount; ++number) {
    if (const auto seen = seen_as(static_cast<lidar::Format>(number), payload)) {
      return *seen;
    }
  }
  SeenUnit foreign;
  foreign.name = name_of_foreign(payload);
  return foreign;
}

}  // namespace iog::tools
