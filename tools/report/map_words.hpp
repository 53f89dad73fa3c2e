// What a target says of its map, for a person and for a script.
#pragma once

#include <string>
#include <string_view>

#include "stream/map_state.hpp"
#include "tools/program/table.hpp"

namespace iog::tools {

// "another origin": why no cell has a class of the map. Empty: some may have one.
[[nodiscard]] std::string_view words_of(map::Cause cause);

// "1a2b3c4d, © OpenStreetMap contributors": the map in use; "none".
[[nodiscard]] std::string name_of_map(const stream::MapState& state);

// "receiving 1a2b3c4d, 12 of 80 chunks"; empty if nothing is on its way.
[[nodiscard]] std::string words_of_delivery(const map::DeliveryReport& delivery);

// "map_crc" and "1a2b3c4d": as RunStatistics::facts() has them.
[[nodiscard]] Facts map_facts(const stream::MapState& state);

// Rows of a table. What counts since the target's start is as of this state.
[[nodiscard]] std::string map_table(const stream::MapState& state);

}  // namespace iog::tools
