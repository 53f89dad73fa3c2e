#include "tools/report/map_words.hpp"

#include <array>
#include <cstddef>
#include <numeric>

#include "tools/map/refusal_text.hpp"
#include "tools/program/hexadecimal.hpp"
#include "tools/program/printable.hpp"
#include "tools/report/names.hpp"

namespace iog::tools {
namespace {

// In the order of map::Cause.
constexpr std::array<std::string_view, map::kCauseCount> kCauseWords{
    "",
    "no map",
    "the poses do not say where the map is",
    "the poses name another origin than the map's",
    "where the map is, is known to no better than 300 mm",
    "the map is too inexact",
    "the window has no place yet",
    "the map does not reach here",
    "the sensors contradict the map"};

std::string_view words_of(map::DeliveryState state) {
  return state == map::DeliveryState::kChecking ? "checking" : "receiving";
}

std::string words_of_refusal(map::Refusal refusal) {
  const auto value = static_cast<std::size_t>(refusal);
  return value < map::kRefusalCount ? refusal_text(refusal) : "reason " + std::to_string(value);
}

}  // namespace

std::string_view words_of(map::Cause cause) {
  const auto value = static_cast<std::size_t>(cause);
  if (value >= kCauseWords.size()) {
    return "a cause that this iog does not know";
  }
  return kCauseWords[value];
}

std::string name_of_map(const stream::MapState& state) {
  if (!state.in_use) {
    return "none";
  }
  return hex(state.layer.crc) + ", " + printable(std::string(state.in_use->words()));
}

std::string words_of_delivery(const map::DeliveryReport& delivery) {
  if (delivery.state == map::DeliveryState::kIdle) {
    return {};
  }
  return std::string(words_of(delivery.state)) + " " + hex(delivery.incoming.crc) + ", " +
         std::to_string(delivery.chunks_there) + " of " +
         std::to_string(map::chunk_count(delivery.incoming)) + " chunks";
}

Facts map_facts(const stream::MapState& state) {
  Facts facts;
  facts.emplace_back("map_crc", state.in_use ? hex(state.layer.crc) : "none");
  facts.emplace_back("map_attribution",
                     state.in_use ? printable(std::string(state.in_use->words())) : "none");
  add_fact(facts, "map_cause", static_cast<std::uint8_t>(state.layer.cause));
  add_fact(facts, "map_blur_cells", state.layer.radius);
  add_fact(facts, "map_tiles_drawn", state.layer.tiles_drawn);
  add_fact(facts, "map_tiles_outside", state.layer.tiles_outside);
  add_fact(facts, "map_tiles_waiting", state.layer.tiles_waiting);
  add_fact(facts, "map_blocks_refused", state.delivery.blocks_refused);
  add_facts(facts, "map_times_", state.layer.begun, kMapCauseNames);
  add_facts(facts, "map_chunks_", state.delivery.fates, kChunkNames);
  return facts;
}

std::string map_table(const stream::MapState& state) {
  std::string text = row("map", name_of_map(state));
  if (state.layer.cause == map::Cause::kNone) {
    text +=
        row("map's tiles", std::to_string(state.layer.tiles_drawn) + " drawn, " +
                               std::to_string(state.layer.tiles_waiting) + " waiting, " +
                               std::to_string(state.layer.tiles_outside) + " outside; blurred by " +
                               std::to_string(state.layer.radius) + " cells");
  } else if (state.in_use) {
    text += row("map not used", std::string(words_of(state.layer.cause)));
  }
  if (const std::string delivery = words_of_delivery(state.delivery); !delivery.empty()) {
    text += row("map on its way", delivery);
  }
  const auto& fates = state.delivery.fates;
  if (std::accumulate(fates.begin(), fates.end(), std::uint64_t{0}) > 0) {
    text += row("map chunks", list_of(fates, kChunkNames));
  }
  if (state.delivery.blocks_refused > 0) {
    text += row("maps refused", std::to_string(state.delivery.blocks_refused) +
                                    ", the last: " + words_of_refusal(state.delivery.last_refusal));
  }
  return text;
}

}  // namespace iog::tools
