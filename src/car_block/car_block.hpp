// The car block is a block of bytes at a fixed offset in an image, and contains the compiled car
// file and the network configuration. The block is written either by the build or by `iog image`.
// The target checks the entire block before it uses any part of it (docs/spec.md, section 8).
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

// The properties of the firmware that are fixed at compile time. A car that requires other
// properties needs a different image.
struct Firmware {
  std::uint16_t cell_mm = 0;
  std::uint16_t cells_per_side = 0;
  std::uint16_t resolution = 0;
  vehicle::Grids grids = vehicle::Grids::kIndexes;
  friend constexpr bool operator==(const Firmware&, const Firmware&) = default;
};

// Returns the properties of the firmware compiled from this source.
[[nodiscard]] Firmware firmware_of(vehicle::Grids grids);

// Writes the complete block. The vehicle must be within the limits, and the network configuration
// must be valid.
void write_block(const vehicle::Vehicle& vehicle, const net::Config& network, WritableBlock block);

// Writes an empty car block. The firmware rejects this block until `iog image` adds a car.
void write_block_without_car(vehicle::Grids grids, const net::Config& network, WritableBlock block);

// Returns the properties of the firmware, or std::nullopt if the firmware record is invalid.
[[nodiscard]] std::optional<Firmware> read_firmware(Block block);

// Adds a key to an existing block. The target then accepts only commands signed with this key.
void write_key(const authentication::Key& key, WritableBlock block);

// Returns the key if the block contains a valid key. If the key is damaged, read_car() rejects the
// car.
[[nodiscard]] std::optional<authentication::Key> read_key(Block block);

// The block stores the network configuration in two records. Returns the configuration in the first
// valid record, or std::nullopt if both records are invalid.
[[nodiscard]] std::optional<net::Config> read_network(Block block);

// The record that was rejected.
enum class Part : std::uint8_t { kCar, kNetwork, kKey };

// The result of checking a block.
struct Verdict {
  Refusal refusal = Refusal::kNone;
  Part part = Part::kCar;  // the refused record
  vehicle::Fault fault{};  // set only for kLimit
};

// Reads and checks a complete car. `grids` specifies the grids of the firmware. `vehicle` refers to
// the block and to `memory`, so both must outlive `vehicle`. Use `vehicle` only if the result is
// kNone.
[[nodiscard]] Verdict read_car(Block block, vehicle::Grids grids, SensorMemory& memory,
                               vehicle::Vehicle& vehicle);

// The message shown when a car block is rejected.
class Words {
 public:
  explicit Words(const Verdict& verdict);
  [[nodiscard]] std::string_view view() const { return {letters_.data(), length_}; }

 private:
  void add(std::string_view text);
  void add_number(std::uint32_t number);

  // The longest list of allowed values is about 110 characters long.
  std::array<char, 200> letters_{};
  std::size_t length_ = 0;
};

}  // namespace iog::car_block
