// A car as its file describes it (docs/vehicles.md): TOML, read without a compiler.
#pragma once

#include <deque>
#include <string>
#include <string_view>
#include <vector>

#include "net/config.hpp"
#include "tools/car/description.hpp"
#include "tools/vehicles/toml_table.hpp"
#include "vehicle/vehicle.hpp"

namespace iog::tools {

// A description with all that it points to.
struct Car {
  std::deque<std::string> names;                 // of the car and of its sensors
  std::deque<std::vector<lidar::Laser>> lasers;  // of its calibrated sensors
  std::deque<ageing::Tables> window_tables;      // if its file has evidential constants
  description::Description description;
  std::vector<description::SensorConfig> sensors;
  net::Config network{};
  std::string key_file;                 // of its authentication; empty: it has none
  std::vector<vehicle::Sensor> tables;  // of the sensors, in their order
  vehicle::Vehicle vehicle;             // what the target would know of it

  Car() = default;
  Car(Car&&) = default;
  Car& operator=(Car&&) = default;
  Car(const Car&) = delete;
  Car& operator=(const Car&) = delete;
  ~Car() = default;
};

// That of QEMU's user network, whose gateway is the PC. A real network gives each box its own.
inline constexpr net::Config kUsualNetwork{
    .mac = {{0x02, 0x69, 0x6F, 0x67, 0x00, 0x01}},  // locally administered
    .address = net::ipv4(10, 0, 2, 15),
    .prefix_bits = 24,
    .peer = net::ipv4(10, 0, 2, 2),
    .peer_port = 15'000,
    .source_port = 15'001,
};

// A description that keeps to all its limits, with its tables. UsageError with every mistake of the
// file, a line each: "car.toml:12: sensors[0].udp_port: allowed is ...".
[[nodiscard]] Car read_car(const std::string& path);

// The same of what stands in the file of that path, which is not opened.
[[nodiscard]] Car parse_car(std::string_view text, const std::string& path);

}  // namespace iog::tools
