#include "car_block/limits.hpp"

#include <algorithm>
#include <cstddef>
#include <functional>
#include <span>

namespace iog::car_block {
namespace {

using vehicle::Fault;
using vehicle::is_within;
using vehicle::Sensor;
using vehicle::Tell;
using vehicle::Vehicle;

constexpr std::size_t kLongestSensorName = 15;
constexpr std::size_t kLongestCarName = 31;

// True if the name has only letters, digits and '_' and does not begin with a digit.
bool is_name(std::string_view name, std::size_t longest) {
  const auto is_allowed = [](char c) {
    return is_within(c, 'a', 'z') || is_within(c, 'A', 'Z') || is_within(c, '0', '9') || c == '_';
  };
  return !name.empty() && name.size() <= longest && !is_within(name.front(), '0', '9') &&
         std::ranges::all_of(name, is_allowed);
}

// Checks the car's name, its frames and its number of sensors.
void check_frames(const Vehicle& car, const Tell& tell) {
  if (!is_name(car.name, kLongestCarName)) {
    tell({.field = "name", .allowed = "at most 31 letters, digits and '_', no digit first"});
  }
  if (!is_within<std::uint32_t>(car.frame_period_us, 10'000, 1'000'000)) {
    tell({.field = "frame_period_us", .allowed = "10000 ... 1000000"});
  }
  if (!is_within<std::uint16_t>(car.epsilon_e5, 1'000, 40'000)) {
    tell({.field = "epsilon", .allowed = "0.01 ... 0.4"});
  }
  if (!is_within<std::uint32_t>(car.window.group_budget, 1, perception::kGroupBudget)) {
    tell({.field = "window.group_budget", .allowed = "1 ... 65536"});
  }
  if (!is_within<std::size_t>(car.sensors.size(), 1, vehicle::kMaxSensors)) {
    tell({.field = "sensors", .allowed = "1 ... 8 of them"});
  }
}

// Classes need cells that are large enough for a useful window of 1024 x 1024 cells. In cells of
// 0.5 m, moving objects cannot be distinguished from flickering ones. Objects are tracked only in
// cells of 0.1 m.
void check_cells(const Vehicle& car, const Tell& tell) {
  const std::uint16_t cell_mm = car.grid.cell_mm;
  const bool has_classes = vehicle::have_classes(car.grids);
  if (has_classes && cell_mm < geometry::kUsualCellMm) {
    tell({.field = "grids", .allowed = "indexes, because classes have cells of 0.1, 0.2 or 0.5 m"});
  } else if (has_classes && car.has_objects && cell_mm != geometry::kUsualCellMm) {
    tell({.field = "objects", .allowed = "false, because objects are tracked in cells of 0.1 m"});
  }
  for (std::size_t i = 0; i < car.sensors.size(); ++i) {
    if (!car.sensors[i].moved.are_given()) {
      continue;
    }
    if (!has_classes && car.grid != geometry::Grid{}) {
      tell({i, "moved", "none, because this grid has no classes"});
    } else if (cell_mm > kCoarsestMovedMm) {
      tell({i, "moved", "none, because cells of 0.5 m do not show what moves"});
    }
  }
}

// The window of classes is at most as large as its memory.
void check_window(window::Extent extent, const Tell& tell) {
  const auto check_side = [&](std::uint8_t tiles, std::string_view field) {
    if (!window::Extent{tiles, tiles}.is_allowed()) {
      tell({.field = field, .allowed = "128 ... 1024 cells, in steps of 32"});
    }
  };
  check_side(extent.columns, "window.side_x_m");
  check_side(extent.rows, "window.side_y_m");
}

// The memory has 1024 x 1024 cells, and each side consists of whole tiles. A line of the longest
// range crosses fewer than 2,048 borders and 512 blocks in any such grid (tests/host/grid).
// Returns false if lengths cannot be converted to cells.
bool check_grid(const Vehicle& car, const Tell& tell) {
  const geometry::Grid& grid = car.grid;
  if (!geometry::is_cell_size(grid.cell_mm)) {
    tell({.field = "grid.cell_m", .allowed = "0.05, 0.1, 0.2 or 0.5"});
    return false;
  }
  const auto check_side = [&](std::uint16_t cells, std::uint16_t origin, std::string_view field,
                              std::string_view allowed) {
    if (cells == 0 || cells % geometry::kTileSide != 0 || cells > geometry::kLongestSide ||
        origin > cells) {
      tell({.field = field, .allowed = allowed, .sum = cells});
    }
  };
  check_side(grid.columns, grid.origin_column, "grid.ahead_m",
             "with behind_m 32 ... 4096 cells, in steps of 32");
  check_side(grid.rows, grid.origin_row, "grid.left_m",
             "with right_m 32 ... 4096 cells, in steps of 32");
  if (grid.tile_count() > geometry::kTileCount) {
    tell({.field = "grid.ahead_m",
          .allowed = "at most 1048576 cells in all",
          .sum = grid.tile_count() * geometry::kTileCells});
  }
  check_cells(car, tell);
  check_window(car.window.extent, tell);
  return true;
}

// True if the error term of the line walk stays below 2^31 for beams of this length. A line spans
// at most sqrt(2) L in |dx| + |dy|; rounding adds less than 10 subcells.
constexpr bool walk_fits(std::uint32_t range_mm, const geometry::Grid& grid) {
  const std::uint64_t span = subcells_up(range_mm, grid) * 1'414'214 / 1'000'000 + 10;
  return span * geometry::kResolution < std::uint64_t{1} << 31;
}

// The words of check_range().
static_assert(geometry::kResolution != 1024 ||
              (walk_fits(72'407, {.cell_mm = 50}) && !walk_fits(72'408, {.cell_mm = 50}) &&
               walk_fits(kLongestRangeMm, {.cell_mm = 100})));

void check_range(const Vehicle& car, std::size_t number, const Tell& tell) {
  const Sensor& sensor = car.sensors[number];
  const std::uint32_t range_mm = sensor.range.mm();
  if (range_mm <= sensor.range_min_mm || range_mm > kLongestRangeMm) {
    tell({number, "range_max_mm", kRangeWords});
    return;
  }
  if (sensor.no_return_clears_mm > range_mm) {
    tell({number, "no_return_clears_mm", "at most range_max_mm"});
  }
  const std::uint32_t longest_mm = longest_line_mm(sensor.format, range_mm);
  if (longest_mm > kLongestRangeMm) {
    tell({number, "range_max_mm", "at most 127999, because its mirror is tilted"});
  } else if (!walk_fits(longest_mm, car.grid)) {
    tell({number, "range_max_mm",
          "at most 72407 with cells of 0.05 m, 71293 of a unit with beam_tilt_deg"});
  }
}

bool is_mode_known(const Sensor& sensor) {
  if (!lidar::facts_of(sensor.format).has_modes) {
    return sensor.columns_per_turn == 0 && sensor.column_ns == 0;
  }
  return std::ranges::any_of(lidar::kTurnModes, [&](const lidar::TurnMode& mode) {
    return mode.columns_per_turn == sensor.columns_per_turn && mode.column_ns() == sensor.column_ns;
  });
}

// True if some lasers do not fire with the others and then report no range.
bool has_silent_lasers(lidar::Format format) {
  bool has_some = false;
  lidar::with_decoder(format, [&]<typename Decoder>(std::type_identity<Decoder> /*which*/) {
    if constexpr (requires { Decoder::unit().bank_lasers; }) {
      has_some = Decoder::unit().bank_lasers != 0;
    }
  });
  return has_some;
}

void check_unit(const Sensor& sensor, std::size_t number, const Tell& tell) {
  const lidar::ScannerFacts facts = lidar::facts_of(sensor.format);
  if (!is_within<std::uint32_t>(sensor.precision_mm, 1, 1000)) {
    tell({number, "precision_mm", "1 ... 1000"});
  }
  if (!is_within<std::uint32_t>(sensor.scan_width_ticks, 1, facts.ticks_per_turn)) {
    tell({number, "scan_width_ticks", "1 ... a whole turn in ticks of the scanner"});
  }
  const std::size_t fewest = lidar::points_of_packet(sensor.format, sensor.layer_count);
  if (sensor.max_points_per_scan < fewest) {
    tell({.sensor = number,
          .field = "max_points_per_scan",
          .allowed = "the points of a packet, of a LUX those of a direction",
          .least = static_cast<std::uint32_t>(fewest)});
  }
  if (sensor.layer_count > vehicle::kMaxLayers ||
      !lidar::can_have_layers(sensor.format, sensor.layer_count) ||
      (!sensor.is_calibrated && !facts.has_elevations && !facts.is_points)) {
    tell({number, "lasers", "one for each layer of the scanner"});
  }
  if (!is_mode_known(sensor)) {
    tell({number, "mode", "512x10 ... 2048x10 of an Ouster, of others none"});
  }
  if (sensor.no_return_clears_mm > 0 && has_silent_lasers(sensor.format)) {
    tell({number, "no_return_clears_mm", "0, because not every laser of this scanner fires"});
  }
  if (sensor.latency_us > 1'000'000) {
    tell({number, "latency_us", "at most 1000000"});
  }
}

// Silence of a radar is no evidence of free space, and silence of an ultrasonic unit is hardly any.
void check_arcs(const Vehicle& car, std::size_t number, const Tell& tell) {
  const Sensor& sensor = car.sensors[number];
  const lidar::ScannerFacts facts = lidar::facts_of(sensor.format);
  if (!facts.marks_arcs()) {
    return;
  }
  const auto words = [&](std::string_view of_radar, std::string_view of_ultrasonic) {
    return facts.is_radar ? of_radar : of_ultrasonic;
  };
  if (vehicle::have_classes(car.grids)) {
    tell({number, "type",
          words("no radar, because grids have classes",
                "no ultrasonic unit, because grids have classes")});
  }
  if (sensor.no_return_clears_mm > 0) {
    tell({number, "no_return_clears_mm",
          words("0, because a radar frees nothing", "0, because silence frees nothing")});
  }
  if (sensor.moved.are_given()) {
    tell({number, "moved",
          words("none, because a radar frees nothing", "none, because an echo has no height")});
  }
  if (sensor.is_calibrated) {
    tell({number, "lasers",
          words("none, because detections of a radar say their directions",
                "none, because an ultrasonic unit has none")});
  }
  if (facts.is_ultrasonic && sensor.range.mm() > kLongestConeMm) {
    tell({number, "range_max_mm", "at most 10000 of an ultrasonic unit"});
  }
}

bool is_source(std::uint32_t ipv4) { return ipv4 == 0 || net::is_host_address({ipv4}); }

bool is_sensor_address_taken(std::span<const Sensor> sensors, std::size_t number,
                             const net::Config& network) {
  const std::uint32_t address = sensors[number].source_ipv4;
  const auto others = sensors.first(number);
  return address != 0 && (address == network.address.value ||
                          std::ranges::find(others, address, &Sensor::source_ipv4) != others.end());
}

// Checks what must differ between sensors: names, ports and addresses.
void check_own(std::span<const Sensor> sensors, std::size_t number, const net::Config& network,
               const Tell& tell) {
  const Sensor& sensor = sensors[number];
  const auto others = sensors.first(number);
  if (!is_name(sensor.name, kLongestSensorName)) {
    tell({number, "name", "at most 15 letters, digits and '_', no digit first"});
  } else if (std::ranges::find(others, sensor.name, &Sensor::name) != others.end()) {
    tell({number, "name", "a name that no other sensor has"});
  }
  if (sensor.udp_port == 0) {
    tell({number, "udp_port", "1 ... 65535"});
  } else if (std::ranges::find(others, sensor.udp_port, &Sensor::udp_port) != others.end()) {
    tell({number, "udp_port", "a port that no other sensor has"});
  }
  if (is_sensor_address_taken(sensors, number, network)) {
    tell({number, "source_ipv4", "an address that nobody else has"});
  } else if (!is_source(sensor.source_ipv4)) {
    tell({number, "source_ipv4", "the address of one host, or 0.0.0.0 for any"});
  }
}

void check_network(const net::Config& network, const Tell& tell) {
  if (!is_within<unsigned>(network.prefix_bits, 8, 30)) {
    tell({.field = "network.prefix_bits", .allowed = "8 ... 30"});
    return;
  }
  if (!network.mac.is_unicast()) {
    tell({.field = "network.mac", .allowed = "the address of one station, its first octet even"});
  }
  if (!net::is_host_in_subnet(network.address, network.address, network.prefix_bits)) {
    tell({.field = "network.address", .allowed = "the address of a host of its subnet"});
  } else if (!net::is_host_in_subnet(network.peer, network.address, network.prefix_bits) ||
             network.peer == network.address) {
    tell({.field = "network.peer", .allowed = "another host of the subnet of network.address"});
  }
  if (network.peer_port == 0) {
    tell({.field = "network.peer_port", .allowed = "1 ... 65535"});
  }
  if (network.source_port == 0) {
    tell({.field = "network.source_port", .allowed = "1 ... 65535"});
  }
}

// Checks the sources of poses and maps.
void check_sources(const Vehicle& car, const net::Config& network, const Tell& tell) {
  const auto is_allowed = [&](std::uint32_t ipv4) {
    return is_source(ipv4) && ipv4 != network.address.value;
  };
  if (!is_allowed(car.poses.source_ipv4)) {
    tell({.field = "poses.source_ipv4", .allowed = "another host's address, or 0.0.0.0 for any"});
  }
  if (!is_allowed(car.maps.source_ipv4)) {
    tell({.field = "maps.source_ipv4", .allowed = "another host's address, or 0.0.0.0 for any"});
  }
}

// Masses and factors must be fractions and must rise or fall monotonically with time.
void check_tables_of_window(const ageing::Tables& tables, const Tell& tell) {
  const auto falls = [](const ageing::DecayTable& decay) {
    return decay.front() < ageing::kUndecayed && std::ranges::is_sorted(decay, std::greater<>());
  };
  const ageing::Accumulation& times = tables.accumulation;
  if (!falls(tables.decays.dynamic) || !falls(tables.decays.fixed) ||
      !falls(tables.decays.shared)) {
    tell({.field = "window.moving_half_life_s", .allowed = kHalfLifeWords});
  }
  if (!is_within<std::uint16_t>(times.full_ms, 100, 60'000) ||
      !is_within<std::uint16_t>(times.empty_ms, 10, times.full_ms) ||
      !is_within<std::uint16_t>(times.specialisations_per_second, 1, 100)) {
    tell({.field = "window.object_m", .allowed = kAccumulationWords});
  }
  if (tables.free.front() <= 0 || !std::ranges::is_sorted(tables.free)) {
    tell({.field = "window.free_mass", .allowed = kMassWords});
  }
  if (!is_within<std::int16_t>(tables.hit_mass, 256, 127 * 256)) {
    tell({.field = "window.hit_mass", .allowed = kMassWords});
  }
}

// Classes need the rule hits_win, the only one that can merge slices of a frame. They need
// blurring, because `nearest` marks cells behind a hit as occupied. Poses and maps need ports of
// their own.
void check_classes(const Vehicle& car, const Tell& tell) {
  const auto is_sensors_port = [&](std::uint16_t udp_port) {
    return std::ranges::find(car.sensors, udp_port, &Sensor::udp_port) != car.sensors.end();
  };
  if (car.rule != vehicle::FusionRule::kHitsWin) {
    tell({.field = "rule", .allowed = "hits_win, because grids have classes"});
  }
  if (car.quantisation != index::Quantisation::kBlurring) {
    tell({.field = "quantisation", .allowed = "blurring, because grids have classes"});
  }
  if (car.poses.log2_slice_ms > 6) {
    tell({.field = "poses.log2_slice_ms", .allowed = "0 ... 6: slices of at most 64 ms"});
  }
  if (car.poses.udp_port == 0 || is_sensors_port(car.poses.udp_port)) {
    tell({.field = "poses.udp_port", .allowed = "1 ... 65535, and no sensor's port"});
  }
  if (car.maps.udp_port == 0 || is_sensors_port(car.maps.udp_port) ||
      car.maps.udp_port == car.poses.udp_port) {
    tell({.field = "maps.udp_port",
          .allowed = "1 ... 65535, and neither a sensor's port nor that of the poses"});
  }
}

}  // namespace

void check_numbers(const Vehicle& car, const net::Config& network, const Tell& tell) {
  check_frames(car, tell);
  if (car.window.tables != nullptr) {
    check_tables_of_window(*car.window.tables, tell);
  }
  const bool has_cells = check_grid(car, tell);
  for (std::size_t i = 0; i < car.sensors.size(); ++i) {
    check_own(car.sensors, i, network, tell);
    if (has_cells) {
      check_range(car, i, tell);
    }
    check_unit(car.sensors[i], i, tell);
    check_arcs(car, i, tell);
  }
  check_network(network, tell);
  check_sources(car, network, tell);
  if (vehicle::have_classes(car.grids)) {
    check_classes(car, tell);
  }
}

Fault fault_of(const Vehicle& car, const net::Config& network) {
  Fault first;
  auto keep = [&](const Fault& fault) { first = first.field.empty() ? fault : first; };
  const Tell tell(keep);
  check_numbers(car, network, tell);
  if (first.field.empty()) {
    check_tables(car, tell);
  }
  return first;
}

}  // namespace iog::car_block
