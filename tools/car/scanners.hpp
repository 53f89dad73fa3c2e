// The scanners that a car can have: a sensor of each with what its data sheet says, of which a
// description changes what is different on its car.
#pragma once

#include <array>
#include <cstddef>
#include <string_view>
#include <type_traits>

#include "lidar/formats.hpp"
#include "tools/car/description.hpp"

namespace iog::description {

constexpr SensorConfig scanner_of(lidar::Format format) {
  SensorConfig config{.format = format};
  lidar::with_decoder(format, [&]<typename Decoder>(std::type_identity<Decoder> /*which*/) {
    constexpr lidar::DataSheet kSheet = Decoder::kDataSheet;
    config.range_min_mm = kSheet.range_min_mm;
    config.range_max_mm = kSheet.range_max_mm;
    config.precision_mm = kSheet.precision_mm;
    config.sigma_m = kSheet.sigma_m;
    config.azimuth_sigma_deg = kSheet.azimuth_sigma_deg;
    config.scan_width_ticks =
        kSheet.scan_width_ticks != 0 ? kSheet.scan_width_ticks : Decoder::kTicksPerTurn;
    config.max_points_per_scan = kSheet.max_points_per_scan;
  });
  return config;
}

// By the name that a car's file gives as `type`.
struct ScannerType {
  std::string_view name;
  lidar::Format format{};
};

namespace scanners_detail {

constexpr void for_each_type(auto&& visit) {
  lidar::for_each_format([&]<typename Decoder>(lidar::Format format,
                                               std::type_identity<Decoder> /*which*/) {
    for (const std::string_view name : {Decoder::kDataSheet.type, Decoder::kDataSheet.type_too}) {
      if (!name.empty()) {
        visit(ScannerType{name, format});
      }
    }
  });
}

constexpr std::size_t kTypeCount = [] {
  std::size_t count = 0;
  for_each_type([&](const ScannerType& /*type*/) { ++count; });
  return count;
}();

}  // namespace scanners_detail

inline constexpr auto kScannerTypes = [] {
  std::array<ScannerType, scanners_detail::kTypeCount> types{};
  std::size_t count = 0;
  scanners_detail::for_each_type([&](const ScannerType& type) { types[count++] = type; });
  return types;
}();

}  // namespace iog::description
