#include "tools/vehicles/two_returns.hpp"

#include <type_traits>

#include "lidar/formats.hpp"

namespace iog::tools {
namespace {

constexpr std::uint64_t kTenHertzNs = 100'000'000;

}  // namespace

bool sends_two_returns(lidar::Format format) {
  bool it_does = false;
  lidar::with_decoder(format, [&]<typename Decoder>(std::type_identity<Decoder> /*which*/) {
    if constexpr (std::is_base_of_v<lidar::OusterPacket, Decoder>) {
      it_does = Decoder::profile().returns() == 2;
    }
  });
  return it_does;
}

std::uint32_t points_with_two_returns(lidar::Format format) {
  std::uint64_t points = 0;
  lidar::with_decoder(format, [&]<typename Decoder>(std::type_identity<Decoder> /*which*/) {
    if constexpr (std::is_base_of_v<lidar::VelodynePacket, Decoder>) {
      constexpr lidar::VelodyneUnit kUnit = Decoder::unit();
      const std::uint64_t points_of_block = lidar::VelodynePacket::kPointsPerBlock * kUnit.banks;
      points = kUnit.has_two_returns ? 2 * kTenHertzNs * points_of_block / kUnit.block_ns : 0;
    } else if constexpr (std::is_base_of_v<lidar::HesaiPacket, Decoder>) {
      constexpr lidar::HesaiUnit kUnit = Decoder::unit();
      points = 2 * kTenHertzNs * kUnit.lasers / static_cast<std::uint64_t>(kUnit.firing_ns);
    }
  });
  return static_cast<std::uint32_t>(points);
}

std::string warning_of_two_returns(const CatalogueEntry& car) {
  std::string text;
  for (const description::SensorConfig& sensor : car.sensors) {
    const std::uint32_t points = points_with_two_returns(sensor.format);
    if (points > sensor.max_points_per_scan) {
      const std::uint64_t dropped = points - sensor.max_points_per_scan;
      text.append("warning: ").append(car.vehicle->name).append(": sensor ").append(sensor.name);
      text += ": with two returns it sends " + std::to_string(points) +
              " points a turn at 10 Hz, and its max_points_per_scan is " +
              std::to_string(sensor.max_points_per_scan) + ": " +
              std::to_string((100 * dropped + points / 2) / points) +
              " % of a turn would be dropped, over budget; set it to one return\n";
    }
  }
  return text;
}

}  // namespace iog::tools
