// A sensor in a car's file, a table of `[[sensors]]`.
#pragma once

#include <cstdint>

#include "tools/vehicles/car_file.hpp"
#include "tools/vehicles/toml_table.hpp"

namespace iog::tools {

// Whose packets are taken: key `source_ipv4`.
void read_source(TomlTable& table, std::uint32_t& source_ipv4);

// Adds the sensor, with what its type gives where the table does not say it.
void read_sensor(TomlTable& table, Car& car);

}  // namespace iog::tools
