#include "tools/info/unit_guess.hpp"

#include <array>
#include <type_traits>
#include <vector>

#include "lidar/formats.hpp"

namespace iog::tools {
namespace {

constexpr std::array<std::size_t, 4> kRows{16, 32, 64, 128};

template <typename Decoder>
GuessedPacket guessed(const Decoder& decoder, std::string_view name, bool is_numbered) {
  return {.name = std::string(name),
          .ticks_per_turn = static_cast<std::uint32_t>(Decoder::kTicksPerTurn),
          .is_numbered = is_numbered,
          .info = decoder.info()};
}

template <typename Decoder>
std::optional<GuessedPacket> guess_ouster(std::span<const std::byte> payload) {
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
        return guessed(decoder, std::string(Decoder::kName) + " " + std::to_string(rows), true);
      }
    }
  }
  return std::nullopt;
}

template <typename Decoder>
std::optional<GuessedPacket> guess_as(std::span<const std::byte> payload) {
  if constexpr (std::is_base_of_v<lidar::OusterPacket, Decoder>) {
    return guess_ouster<Decoder>(payload);
  } else if constexpr (std::is_base_of_v<lidar::HesaiPacket, Decoder>) {
    Decoder decoder;
    if (decoder.decode(payload) == lidar::DecodeStatus::kOk) {
      return guessed(decoder, Decoder::kName, false);
    }
  }
  return std::nullopt;
}

template <typename... Decoder>
std::optional<GuessedPacket> guess_among(std::span<const std::byte> payload,
                                         std::type_identity<std::variant<Decoder...>> /*all*/) {
  std::optional<GuessedPacket> found;
  const auto is_found = [&](std::optional<GuessedPacket> one) {
    found = std::move(one);
    return found.has_value();
  };
  static_cast<void>((is_found(guess_as<Decoder>(payload)) || ...));
  return found;
}

}  // namespace

std::optional<GuessedPacket> guess_unit(std::span<const std::byte> payload) {
  return guess_among(payload, std::type_identity<lidar::AnyDecoder>());
}

}  // namespace iog::tools
