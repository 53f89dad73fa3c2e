#include "car_block/read_vehicle.hpp"

#include <bit>
#include <string_view>
#include <type_traits>

#include "car_block/content.hpp"
#include "lidar/scanner_facts.hpp"
#include "vehicle/derived.hpp"
#include "wire/byte_reader.hpp"

namespace iog::car_block {
namespace {

bool can_be_steps(std::uint32_t steps, std::uint32_t ticks_per_turn, bool turns) {
  if (!turns) {
    return steps == ticks_per_turn;
  }
  return std::has_single_bit(steps) && steps >= vehicle::kFewestAzimuthSteps &&
         steps <= vehicle::kMostAzimuthSteps;
}

// After an invalid value ok() stays false, and values read afterwards are meaningless.
class Reader {
 public:
  // Strings are views of `bytes`, sensors are views of `memory`.
  Reader(std::span<const std::byte> bytes, SensorMemory& memory) : in_(bytes), memory_(memory) {}

  [[nodiscard]] bool ok() const { return holds_ && in_.ok(); }
  [[nodiscard]] bool is_at_end() const { return in_.remaining() == 0; }
  [[nodiscard]] bool is_of_other_grid() const { return is_of_other_grid_; }

  void numbers(auto&... values) {
    ((values = number<std::remove_reference_t<decltype(values)>>()), ...);
  }

  // Reads a byte that must be below `count`.
  template <typename Value>
  void below(unsigned count, Value& value) {
    const std::uint8_t read = in_.u8();
    demand(read < count);
    value = static_cast<Value>(read);
  }
  void truth(bool& value) { below(2, value); }
  void grids_and_objects(vehicle::Grids& grids, bool& has_objects) {
    unsigned bits = 0;
    below(8, bits);
    grids = static_cast<vehicle::Grids>(bits & 3U);
    const bool is_off = (bits & 4U) != 0;
    demand(grids <= vehicle::Grids::kBoth && (!is_off || vehicle::have_classes(grids)));
    has_objects = vehicle::have_classes(grids) && !is_off;
  }
  void quantisation_and_epsilon(index::Quantisation& quantisation, std::uint16_t& epsilon_e5) {
    unsigned bits = 0;
    below(4, bits);
    quantisation = static_cast<index::Quantisation>(bits & 1U);
    epsilon_e5 = vehicle::kUsualEpsilonE5;
    if ((bits & 2U) != 0) {
      numbers(epsilon_e5);
      demand(epsilon_e5 != vehicle::kUsualEpsilonE5);
    }
  }
  void shares_and_heights(bool& layers_share_lines, vehicle::GroundLimits& ground,
                          vehicle::MovedLimits& moved) {
    unsigned bits = 0;
    below(8, bits);
    layers_share_lines = (bits & 1U) != 0;
    ground = {};
    if ((bits & 2U) != 0) {
      numbers(ground.low_mm, ground.top_mm);
      demand(ground.is_followed());
    }
    moved = {};
    if ((bits & 4U) != 0) {
      numbers(moved.low_mm, moved.tall_mm);
      demand(moved.are_given());
    }
  }

  // Reads letters up to the required 0.
  void text(std::string_view& text) {
    wire::ByteReader ahead = in_;
    std::size_t length = 0;
    while (ahead.u8() != 0) {
      ++length;
    }
    const std::span<const std::byte> letters = in_.bytes(length);
    in_.skip(1);
    text = {reinterpret_cast<const char*>(letters.data()), letters.size()};
  }

  void format(lidar::Format& format) {
    std::string_view name;
    text(name);
    bool is_known = false;
    lidar::for_each_format([&](lidar::Format each, auto /*decoder*/) {
      if (lidar::name_of(each) == name) {
        format = each;
        is_known = true;
      }
    });
    demand(is_known);
  }

  void arc(lidar::Format format, sensor_model::Arc& arc) {
    arc = {};
    if (lidar::facts_of(format).is_ultrasonic) {
      content_detail::visit_cone(*this, arc);
    } else if (lidar::facts_of(format).is_radar) {
      content_detail::visit_arc(*this, arc);
    }
  }

  // A length of 0 has no reciprocal. The limits later check whether the length is too short or too
  // long.
  void length(traversal::LineLength& length) {
    const auto mm = number<std::uint32_t>();
    demand(mm > 0 && mm < std::uint32_t{1} << 18);
    length = traversal::LineLength(ok() ? mm : 1);
  }

  // Two numbers determine the tables. The format determines the first of them.
  void azimuths(vehicle::Sensor& sensor) {
    const auto ticks_per_turn = number<std::uint32_t>();
    const auto steps = number<std::uint32_t>();
    lidar::with_decoder(
        sensor.format, [&]<typename Decoder>(std::type_identity<Decoder> /*which*/) {
          const bool fits = ticks_per_turn == std::uint32_t{Decoder::kTicksPerTurn} &&
                            can_be_steps(steps, ticks_per_turn, Decoder::kTurns);
          demand(fits);
          if (fits) {
            vehicle::derive_azimuths<Decoder>(steps, sensor);
          }
        });
  }

  void grid(geometry::Grid& grid) {
    std::uint16_t side = 0;
    std::uint16_t resolution = 0;
    grid = {};
    numbers(grid.cell_mm, side, resolution);
    const bool is_other =
        (side != 0 && side != geometry::kCellsPerSide) || resolution != geometry::kResolution;
    if (side == 0) {
      numbers(grid.columns, grid.rows, grid.origin_column, grid.origin_row);
      demand(!grid.is_whole());
    }
    is_of_other_grid_ = is_other && ok();
  }

  void moved_tables_and_extent(perception::Moved& moved, const ageing::Tables*& tables,
                               window::Extent& extent) {
    unsigned bits = 0;
    below(8, bits);
    moved = static_cast<perception::Moved>(bits & 1U);
    tables = nullptr;
    if ((bits & 2U) != 0 && ok()) {
      ageing::Tables& read = memory_.tables;
      content_detail::visit_tables(*this, read);
      read.free[0] = read.free[1];
      tables = &read;
    }
    extent = {};
    if ((bits & 4U) != 0) {
      numbers(extent.columns, extent.rows);
      demand(extent != window::Extent{});
    }
  }

  // Reads one of the firmware's own assignments, or none.
  void assignment(const evidence::Assignment*& assignment) {
    bool is_there = false;
    truth(is_there);
    assignment = nullptr;
    if (is_there) {
      evidence::Assignment read;
      content_detail::visit_assignment(*this, read);
      const bool is_reinforced = read == evidence::kReinforced;
      demand(is_reinforced || read == evidence::kIsopignistic);
      assignment = is_reinforced ? &evidence::kReinforced : &evidence::kIsopignistic;
    }
  }

  void sensors(std::span<const vehicle::Sensor>& sensors, auto&& visit) {
    std::uint8_t count = 0;
    below(vehicle::kMaxSensors + 1, count);
    for (std::size_t i = 0; i < count && ok(); ++i) {
      visit(memory_.sensors[i]);
    }
    sensors = std::span(memory_.sensors).first(ok() ? count : 0);
  }

 private:
  template <std::integral Value>
  [[nodiscard]] Value number() {
    std::uint64_t bits = 0;
    for (std::size_t byte = 0; byte < sizeof(Value); ++byte) {
      bits = bits << 8 | in_.u8();
    }
    return static_cast<Value>(bits);
  }
  void demand(bool holds) { holds_ = holds_ && holds; }

  wire::ByteReader in_;
  SensorMemory& memory_;
  bool holds_ = true;
  bool is_of_other_grid_ = false;
};

}  // namespace

SensorMemory::SensorMemory() = default;

Refusal read_vehicle(std::span<const std::byte> content, SensorMemory& memory,
                     vehicle::Vehicle& vehicle) {
  Reader in(content, memory);
  content_detail::visit_car(in, vehicle);
  if (in.is_of_other_grid()) {
    return Refusal::kOtherGrid;
  }
  for (vehicle::Sensor& sensor : memory.sensors) {
    sensor.grid = vehicle.grid;
  }
  return in.ok() && in.is_at_end() ? Refusal::kNone : Refusal::kNotACar;
}

}  // namespace iog::car_block
