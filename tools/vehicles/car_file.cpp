#include "tools/vehicles/car_file.hpp"

#include <algorithm>
#include <filesystem>
#include <fstream>
#include <set>
#include <span>
#include <sstream>

#include "car_block/limits.hpp"
#include "tools/car/defaults.hpp"
#include "tools/car/limits.hpp"
#include "tools/car/tables.hpp"
#include "tools/program/exit_status.hpp"
#include "tools/vehicles/car_sensor.hpp"
#include "tools/vehicles/car_words.hpp"
#include "tools/vehicles/toml_refusal.hpp"

namespace iog::tools {
namespace {

using Mistakes = std::vector<Mistake>;

// More is not a car's file, or has one mistake in all its lines.
constexpr std::size_t kMostTold = 50;

description::FootprintConfig read_footprint(TomlTable table) {
  description::FootprintConfig footprint;
  table.read("x_min_m", footprint.x_min_m);
  table.read("x_max_m", footprint.x_max_m);
  table.read("y_min_m", footprint.y_min_m);
  table.read("y_max_m", footprint.y_max_m);
  table.demand({"x_min_m", "x_max_m", "y_min_m", "y_max_m"});
  table.refuse_others();
  return footprint;
}

// By default, each side is 512 cells away from the origin.
description::GridConfig read_grid(TomlTable table) {
  double cell_m = description::GridConfig{}.cell_m;
  table.read("cell_m", cell_m);
  description::GridConfig grid{.cell_m = cell_m};
  table.read("ahead_m", grid.ahead_m);
  table.read("behind_m", grid.behind_m);
  table.read("left_m", grid.left_m);
  table.read("right_m", grid.right_m);
  table.refuse_others();
  return grid;
}

pose::SourceDescription read_poses(TomlTable table) {
  pose::SourceDescription poses;
  read_source(table, poses.source_ipv4);
  table.read("udp_port", poses.udp_port);
  table.read("log2_slice_ms", poses.log2_slice_ms);
  table.refuse_others();
  return poses;
}

map::SourceDescription read_maps(TomlTable table) {
  map::SourceDescription maps;
  read_source(table, maps.source_ipv4);
  table.read("udp_port", maps.udp_port);
  table.refuse_others();
  return maps;
}

perception::Rules read_window(TomlTable table, description::WindowConfig& sides,
                              description::EvidenceConfig& evidence) {
  perception::Rules rules;
  for (const auto& [key, side] :
       {std::pair{"side_x_m", &sides.side_x_m}, std::pair{"side_y_m", &sides.side_y_m}}) {
    if (table.has(key)) {
      table.read(key, side->emplace());
    }
  }
  table.read("slowest_m_s", evidence.slowest_m_s);
  table.read("object_m", evidence.object_m);
  table.read("gap_m", evidence.gap_m);
  table.read("scans_per_second", evidence.scans_per_second);
  table.read("free_mass", evidence.free_mass);
  table.read("hit_mass", evidence.hit_mass);
  table.read("moving_half_life_s", evidence.moving_half_life_s);
  table.read("static_half_life_s", evidence.static_half_life_s);
  table.read("discounting", rules.discounting, kDiscountingWords);
  table.read("weighing", rules.weighing, kWeighingWords);
  table.read("assignment", rules.assignment, kAssignmentWords);
  table.read("moved", rules.moved, kMovedWords);
  table.read("group_budget", rules.group_budget);
  table.refuse_others();
  return rules;
}

net::Config read_network(TomlTable table) {
  net::Config network = kUsualNetwork;
  table.read("mac", network.mac);
  table.read("address", network.address);
  table.read("prefix_bits", network.prefix_bits);
  table.read("peer", network.peer);
  table.read("peer_port", network.peer_port);
  table.read("source_port", network.source_port);
  table.read("service_instance", network.service_instance);
  table.refuse_others();
  return network;
}

// Where the key is to be found; it is read by whoever needs it.
std::string read_authentication(TomlTable table, const std::string& path) {
  std::string key_file;
  table.read("key_file", key_file);
  table.demand({"key_file"});
  table.refuse_others();
  if (!key_file.empty()) {
    key_file = std::filesystem::path(path).parent_path() / key_file;
  }
  return key_file;
}

// What opens ground is said by default where classes are made of what follows it.
void add_usual_moved(std::vector<TomlTable>& tables, Car& car) {
  const bool shows_motion =
      description::grid_of(car.description.grid).cell_mm <= car_block::kCoarsestMovedMm;
  for (std::size_t i = 0; i < tables.size() && shows_motion; ++i) {
    description::SensorConfig& sensor = car.sensors[i];
    if (vehicle::have_classes(car.description.grids) && sensor.ground && !tables[i].has("moved")) {
      sensor.moved = description::usual_moved(sensor.ground);
    }
  }
}

// All sensors, and what follows from them where the file does not say it.
void read_sensors(std::vector<TomlTable>& tables, Car& car) {
  car.description.z_min_m = description::kUsualZMinM;
  for (TomlTable& table : tables) {
    read_sensor(table, car);
    car.description.z_max_m =
        std::max(car.description.z_max_m, description::top_m_over(car.sensors.back().mount.z_m));
  }
  description::share_turn_lines(car.sensors, description::grid_of(car.description.grid).cell_mm);
}

// In TOML, keys of the car that stand below a [[sensors]] are keys of this sensor.
void tell_keys_of_car(const TomlTable& car, Mistakes& mistakes) {
  for (Mistake& mistake : mistakes) {
    const std::size_t dot = mistake.field.rfind('.');
    const bool is_of_sensor =
        mistake.field.starts_with("sensors[") && dot == mistake.field.find('.');
    if (mistake.is_unknown && is_of_sensor && car.knows(mistake.field.substr(dot + 1))) {
      mistake.words = "no such key; it is one of the car: write it above the first [[sensors]]";
    }
  }
}

Car read_fields(const toml::table& file, const std::string& path, Mistakes& mistakes) {
  TomlTable table(file, "", mistakes);
  Car car;
  description::Description& description = car.description;
  table.read("name", car.names.emplace_back());
  description.name = car.names.back();
  description.footprint = read_footprint(table.table("footprint"));
  description.grid = read_grid(table.table("grid"));
  std::vector<TomlTable> sensors = table.tables("sensors");
  read_sensors(sensors, car);
  table.read("z_min_m", description.z_min_m);
  table.read("z_max_m", description.z_max_m);
  table.read("epsilon", description.epsilon);
  table.read("quantisation", description.quantisation, kQuantisationWords);
  table.read("rule", description.rule, kRuleWords);
  description.grids = description::usual_grids(description, car.sensors);
  table.read("grids", description.grids, kGridsWords);
  description.frame_period_us = description::usual_frame_period_us(car.sensors, description.grids);
  table.read("frame_period_us", description.frame_period_us);
  description.poses = read_poses(table.table("poses"));
  description.maps = read_maps(table.table("maps"));
  description.window =
      read_window(table.table("window"), description.window_sides, description.evidence);
  description.objects = description::grid_of(description.grid).cell_mm == geometry::kCellMm;
  table.read("objects", description.objects);
  car.network = read_network(table.table("network"));
  car.key_file = read_authentication(table.table("authentication"), path);
  add_usual_moved(sensors, car);
  table.demand({"name", "footprint", "sensors"});
  table.refuse_others();
  tell_keys_of_car(table, mistakes);
  return car;
}

std::string text_of(const std::string& path) {
  if (!std::filesystem::is_regular_file(path)) {
    throw UsageError(path + (std::filesystem::exists(path) ? ": it is a folder or device, no file"
                                                           : ": there is no such file"));
  }
  std::ifstream file(path, std::ios::binary);
  std::ostringstream text;
  text << file.rdbuf();
  if (!file) {
    throw UsageError(path + ": cannot be read");
  }
  return text.str();
}

toml::table parse(std::string_view text, const std::string& path) {
  if (const auto refusal = refused_before_reading(text)) {
    throw UsageError(path + ':' + std::to_string(refusal->line) + ": " +
                     std::string(refusal->words));
  }
  try {
    return toml::parse(text);
  } catch (const toml::parse_error& error) {
    throw UsageError(path + ':' + std::to_string(error.source().begin.line) +
                     ": this is not TOML: " + std::string(error.description()));
  }
}

std::string words_of(const std::string& path, Mistakes& mistakes) {
  std::ranges::stable_sort(mistakes, {}, &Mistake::line);
  std::string words;
  for (const Mistake& mistake : std::span(mistakes).first(std::min(mistakes.size(), kMostTold))) {
    words += (words.empty() ? "" : "\n") + path + ':' + std::to_string(mistake.line) + ": " +
             mistake.field + ": " + mistake.words;
  }
  if (mistakes.size() > kMostTold) {
    words += "\n" + path + ": and " + std::to_string(mistakes.size() - kMostTold) + " more";
  }
  return words;
}

// The node that holds the field, or the innermost table around it that there is.
const toml::node& node_of(const toml::table& file, const vehicle::Fault& fault) {
  const toml::node* node = &file;
  if (const toml::node* const sensor = file["sensors"][fault.sensor].node()) {
    node = sensor;
  }
  std::string_view rest = fault.field;
  while (!rest.empty() && node->is_table()) {
    const std::size_t dot = std::min(rest.find('.'), rest.size());
    const toml::node* const inner = node->as_table()->get(rest.substr(0, dot));
    if (inner == nullptr) {
      break;
    }
    node = inner;
    rest.remove_prefix(std::min(dot + 1, rest.size()));
  }
  return *node;
}

// Whether the fields are equal or one contains the other.
bool overlap(std::string_view one, std::string_view other) {
  const std::size_t shorter = std::min(one.size(), other.size());
  const std::string_view rest = (one.size() > shorter ? one : other).substr(shorter);
  return one.substr(0, shorter) == other.substr(0, shorter) &&
         (rest.empty() || rest.starts_with('.') || rest.starts_with('['));
}

// Whether the words name the key, not a longer one.
bool name_key(std::string_view words, std::string_view key) {
  const std::size_t at = words.find(key);
  return at != std::string_view::npos &&
         words.substr(at + key.size()).find_first_of("abcdefghijklmnopqrstuvwxyz_") != 0;
}

// Notes the faults that checks report, the first of each field. Nothing more is reported of a value
// that could not be read, nor of fields that depend on it: all of a sensor on its type, others by
// the words.
class Listener {
 public:
  Listener(const toml::table& file, Mistakes& mistakes)
      : file_(&file), mistakes_(&mistakes), unread_(mistakes) {
    std::erase_if(unread_, &Mistake::is_unknown);
    is_sound_ = unread_.empty();
  }

  // Whether tables can be made of it.
  [[nodiscard]] bool is_sound() const { return is_sound_; }

  void operator()(const vehicle::Fault& fault) {
    std::string field(fault.field);
    if (fault.sensor != vehicle::Fault::kCar) {
      field = "sensors[" + std::to_string(fault.sensor) + "]." + field;
    }
    is_sound_ = false;
    if (depends_on_unread(fault, field) || !told_.insert(field).second) {
      return;
    }
    std::string text = "allowed is ";
    text += fault.least > 0 ? "at least " + std::to_string(fault.least) + ": " : "";
    text += fault.allowed;
    text += fault.sum > 0 ? "; here it is " + std::to_string(fault.sum) : "";
    const std::uint32_t line = node_of(*file_, fault).source().begin.line;
    mistakes_->push_back({std::max(line, std::uint32_t{1}), field, text});
  }

 private:
  [[nodiscard]] bool depends_on_unread(const vehicle::Fault& fault,
                                       const std::string& field) const {
    return std::ranges::any_of(unread_, [&](const Mistake& unread) {
      const std::string key = unread.field.substr(unread.field.rfind('.') + 1);
      return overlap(unread.field, field) || name_key(fault.allowed, key) ||
             unread.field == "sensors[" + std::to_string(fault.sensor) + "].type";
    });
  }

  const toml::table* file_;
  Mistakes* mistakes_;
  Mistakes unread_;
  bool is_sound_ = true;
  std::set<std::string> told_;
};

void check_key(const Car& car, const vehicle::Tell& tell) {
  if (!car.key_file.empty() && !vehicle::have_classes(car.description.grids)) {
    tell({.field = "authentication",
          .allowed = "none, because a car whose grids have no classes takes no commands"});
  }
}

}  // namespace

Car parse_car(std::string_view text, const std::string& path) {
  const toml::table file = parse(text, path);
  Mistakes mistakes;
  Car car = read_fields(file, path, mistakes);
  Listener listener(file, mistakes);
  const vehicle::Tell tell(listener);
  check_key(car, tell);
  description::check(car.description, car.sensors, tell);
  for (const description::SensorConfig& sensor : car.sensors) {
    car.tables.push_back(description::numbers_of(sensor));
  }
  car_block::check_numbers(description::numbers_of(car.description, car.tables), car.network, tell);
  if (!listener.is_sound()) {
    throw UsageError(words_of(path, mistakes));
  }
  for (std::size_t i = 0; i < car.sensors.size(); ++i) {
    car.tables[i] = description::sensor_of(car.sensors[i], car.description);
  }
  if (const auto tables = description::tables_of(car.description.evidence)) {
    car.description.window.tables = &car.window_tables.emplace_back(*tables);
  }
  car.vehicle = description::vehicle_of(car.description, car.tables);
  car_block::check_tables(car.vehicle, tell);
  if (!mistakes.empty()) {
    throw UsageError(words_of(path, mistakes));
  }
  return car;
}

Car read_car(const std::string& path) { return parse_car(text_of(path), path); }

}  // namespace iog::tools
