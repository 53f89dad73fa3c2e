// The car in an image: a block of bytes at a fixed offset that contains the compiled car file and
// the network configuration. The block is written by the build or by `iog image`. The target checks
// the whole block before it uses any part (docs/spec.md, section 8).
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

// The properties that are fixed when the firmware is compiled. A car that requires other properties
// requires another image.
struct Firmware {
  std::uint16_t cell_mm = 0;
  std::uint16_t cells_per_side = 0;
  std::uint16_t resolution = 0;
  vehicle::Grids grids = vehicle::Grids::kIndexes;
  friend constexpr bool operator==(const Firmware&, const Firmware&) = default;
};

// The properties of firmware compiled from this source.
[[nodiscard]] Firmware firmware_of(vehicle::Grids grids);

// Writes the whole block. The vehicle must be within the limits, and the network configuration must
// be valid.
void write_block(const vehicle::Vehicle& vehicle, const net::Config& network, WritableBlock block);

// Writes a block without a car. The firmware refuses this block until `iog image` adds a car.
void write_block_without_car(vehicle::Grids grids, const net::Config& network, WritableBlock block);

// Returns nothing if the record is invalid.
[[nodiscard]] std::optional<Firmware> read_firmware(Block block);

// Adds a key to an existing block. The target then accepts only commands signed with this key.
void write_key(const authentication::Key& key, WritableBlock block);

// Returns the key if there is a valid one. If the key is damaged, read_car() refuses the car.
[[nodiscard]] std::optional<authentication::Key> read_key(Block block);

// Returns the network configuration of the first valid record of two, or nothing if neither is
// valid.
[[nodiscard]] std::optional<net::Config> read_network(Block block);

// The record that was refused.
enum class Part : std::uint8_t { kCar, kNetwork, kKey };

// The result of checking a block.
struct Verdict {
  Refusal refusal = Refusal::kNone;
  Part part = Part::kCar;  // the refused record
  vehicle::Fault fault{};  // set only for kLimit
};

// Reads and checks a whole car. grids: the grids of the firmware. `vehicle` refers to the block and
// to `memory`, which must outlive it. Use it only if the result is kNone.
[[nodiscard]] Verdict read_car(Block block, vehicle::Grids grids, SensorMemory& memory,
                               vehicle::Vehicle& vehicle);

// The message about a refused car. The console, the stream and `iog image` use it.
class Words {
 public:
  explicit Words(const Verdict& verdict);
  [[nodiscard]] std::string_view view() const { return {letters_.data(), length_}; }

 private:
  void add(std::string_view text);
  void add_number(std::uint32_t number);

  // The longest list of allowed values has about 110 characters.
  std::array<char, 200> letters_{};
  std::size_t length_ = 0;
};

}  // namespace iog::car_block
