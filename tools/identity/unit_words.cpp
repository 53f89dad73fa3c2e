#include "tools/identity/unit_words.hpp"

#include "lidar/formats.hpp"
#include "lidar/scanner_facts.hpp"

namespace iog::tools {
namespace {

bool is_name_of_ours(std::string_view name) {
  bool is_one = false;
  for (unsigned number = 0; number < lidar::kFormatCount; ++number) {
    is_one = is_one || lidar::name_of(static_cast<lidar::Format>(number)) == name;
  }
  return is_one;
}

}  // namespace

std::string with_article(std::string_view name) {
  const bool is_spoken_open =
      std::string_view("AEIOUaeiou").find(name.front()) != std::string::npos;
  return (is_spoken_open ? "an " : "a ") + std::string(name);
}

std::string sensor_words(const CatalogueEntry& car, std::size_t number) {
  const description::SensorConfig& sensor = car.sensors[number];
  std::string words(lidar::name_of(sensor.format));
  if (sensor.mode != lidar::TurnMode{}) {
    words += " " + std::to_string(car.vehicle->sensors[number].layer_count) + ", " +
             std::to_string(sensor.mode.columns_per_turn) + "x" +
             std::to_string(sensor.mode.turns_per_second);
  }
  return words;
}

std::string_view fault_of(const SeenUnit& seen) {
  if (seen.is_sound || !is_name_of_ours(seen.name)) {
    return {};
  }
  const bool is_whole = seen.formats.is_empty() || seen.status == lidar::DecodeStatus::kWrongType;
  return is_whole ? kOfOtherMode : kDamaged;
}

}  // namespace iog::tools
