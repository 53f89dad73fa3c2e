// Counts the commands that a target has received, and signs these counts.
#pragma once

#include <array>
#include <bit>
#include <cstddef>
#include <cstdint>
#include <string_view>

#include "authentication/secured_message.hpp"

namespace iog::authentication {

struct CommandCounts {
  struct OfOneKind {
    std::array<std::uint32_t, kVerdictCount> verdicts{};
    std::uint32_t counter = 0;  // counter of the last authentic message
  };
  std::array<OfOneKind, 2> kinds{};  // poses, maps
  std::array<std::uint32_t, 2> signature{};

  // The names of the counters in the stream (stream/target_table.hpp).
  static constexpr auto kNames = std::to_array<std::string_view>(
      {"poses authentic", "poses unsigned", "poses replayed", "poses forged", "poses last counter",
       "maps authentic", "maps unsigned", "maps replayed", "maps forged", "maps last counter",
       "commands MAC"});

  // Computes the expected signature of these counts. `data_id` is the stream's data ID. `run` is
  // the target's run number.
  [[nodiscard]] std::array<std::uint32_t, 2> signature_by(const CmacKey& key, std::uint16_t data_id,
                                                          std::uint32_t run) const {
    constexpr std::size_t kWords = sizeof(kinds) / sizeof(std::uint32_t);
    return mac_of_counters(key, data_id, run,
                           std::bit_cast<std::array<std::uint32_t, kWords>>(kinds));
  }
};

}  // namespace iog::authentication
