// The car of an image: its description and network as a block of bytes at a known place, written
// by the build or by `iog image`, and believed only when all of it has been checked (docs/spec.md,
// section 8).
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <string_view>

#include "authentication/key.hpp"
#include "car_block/layout.hpp"
#include "car_block/read_vehicle.hpp"
#include "car_block/record.hpp"
#include "net/config.hpp"
#include "vehicle/fault.hpp"
#include "vehicle/vehicle.hpp"

namespace iog::car_block {

// What a firmware is compiled for. A car of another kind needs another image.
struct Firmware {
  std::uint16_t cell_mm = 0;
  std::uint16_t cells_per_side = 0;
  std::uint16_t resolution = 0;
  vehicle::Grids grids = vehicle::Grids::kIndexes;
  friend constexpr bool operator==(const Firmware&, const Firmware&) = default;
};

// A firmware of this source's grid.
[[nodiscard]] Firmware firmware_of(vehicle::Grids grids);

// Writes all of the block. The vehicle is sound, and the network valid.
void write_block(const vehicle::Vehicle& vehicle, const net::Config& network, WritableBlock block);

// The same of a firmware for cars to come, which is refused until there is one.
void write_block_without_car(vehicle::Grids grids, const net::Config& network, WritableBlock block);

// Nothing: the block does not say.
[[nodiscard]] std::optional<Firmware> read_firmware(Block block);

// Asks for commands that are signed with that key, in a block that has been written.
void write_key(const authentication::Key& key, WritableBlock block);

// The key, if there is one. What is damaged is not taken for none: read_car() refuses it.
[[nodiscard]] std::optional<authentication::Key> read_key(Block block);

// That of either of its two records; nothing if both are damaged or not valid.
[[nodiscard]] std::optional<net::Config> read_network(Block block);

// Which of the records.
enum class Part : std::uint8_t { kCar, kNetwork, kKey };

// What has become of a block.
struct Verdict {
  Refusal refusal = Refusal::kNone;
  Part part = Part::kCar;  // that was refused
  vehicle::Fault fault{};  // of kLimit
};

// All of a car, checked. grids: of the firmware. vehicle refers to the block and to the memory;
// it must not be used unless kNone is returned.
[[nodiscard]] Verdict read_car(Block block, vehicle::Grids grids, SensorMemory& memory,
                               vehicle::Vehicle& vehicle);

// What console, wire and `iog image` say of a car that is refused.
class Words {
 public:
  explicit Words(const Verdict& verdict);
  [[nodiscard]] std::string_view view() const { return {letters_.data(), length_}; }

 private:
  void add(std::string_view text);
  void add_number(std::uint32_t number);

  // The longest allowed of a fault has some 110 letters.
  std::array<char, 200> letters_{};
  std::size_t length_ = 0;
};

}  // namespace iog::car_block
