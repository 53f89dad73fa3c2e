// A car's block as bytes, and a copy of a car to change.
#pragma once

#include <cstdint>
#include <gtest/gtest.h>
#include <memory>
#include <vector>

#include "car_block/car_block.hpp"
#include "fakes/bitwise_crc32.hpp"
#include "vehicles/cars.hpp"

namespace iog::tests {

class CarBytes {
 public:
  static constexpr std::size_t kCarAt = 128;  // docs/spec.md, section 8
  static constexpr std::size_t kContentAt = kCarAt + 16;

  explicit CarBytes(const vehicles::Car& written) : grids_(written.vehicle.grids) {
    car_block::write_block(written.vehicle, written.network, writable());
  }

  [[nodiscard]] car_block::Block block() const {
    return std::span<const std::byte>(bytes_).first<car_block::kBlockBytes>();
  }
  [[nodiscard]] car_block::WritableBlock writable() {
    return std::span(bytes_).first<car_block::kBlockBytes>();
  }
  [[nodiscard]] std::byte& at(std::size_t offset) { return bytes_.at(offset); }
  [[nodiscard]] std::uint32_t be32(std::size_t offset) const {
    std::uint32_t value = 0;
    for (std::size_t i = 0; i < 4; ++i) {
      value = value << 8 | std::to_integer<std::uint32_t>(bytes_.at(offset + i));
    }
    return value;
  }
  void put_be32(std::size_t offset, std::uint32_t value) {
    for (std::size_t i = 0; i < 4; ++i) {
      bytes_.at(offset + i) = static_cast<std::byte>(value >> (24 - 8 * i));
    }
  }
  [[nodiscard]] std::span<std::byte> content() {
    return std::span(bytes_).subspan(kContentAt, be32(kCarAt + 8));
  }
  // After its content has been changed.
  void mend_crc() { put_be32(kCarAt + 12, BitwiseCrc32().add(content()).value()); }

  // What the firmware makes of it.
  car_block::Verdict read() { return read(grids_); }
  car_block::Verdict read(vehicle::Grids grids) {
    return car_block::read_car(block(), grids, *memory_, car);
  }

  vehicle::Vehicle car;  // after read()

 private:
  vehicle::Grids grids_;
  std::vector<std::byte> bytes_ = std::vector<std::byte>(car_block::kBlockBytes);
  std::unique_ptr<car_block::SensorMemory> memory_ = std::make_unique<car_block::SensorMemory>();
};

}  // namespace iog::tests
