#include "vehicles/cars.hpp"

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>

#include "car_block/car_block.hpp"
#include "require/require.hpp"

// NOLINTBEGIN(readability-identifier-naming, modernize-avoid-c-arrays): symbols of the assembly
extern "C" const std::uint32_t car_block_count;
extern "C" const std::byte car_blocks[];
// NOLINTEND(readability-identifier-naming, modernize-avoid-c-arrays)

namespace iog::vehicles {
namespace {

constexpr std::size_t kMostCars = 24;

class Fleet {
 public:
  Fleet() {
    require(car_block_count <= kMostCars);
    for (std::size_t i = 0; i < car_block_count; ++i) {
      read(car_block::Block(&car_blocks[i * car_block::kBlockBytes], car_block::kBlockBytes),
           sensors_[i], cars_[i]);
    }
  }

  [[nodiscard]] std::span<const Car> cars() const {
    return std::span(cars_).first(car_block_count);
  }

 private:
  static void read(car_block::Block block, car_block::SensorMemory& sensors, Car& car) {
    const std::optional<car_block::Firmware> firmware = car_block::read_firmware(block);
    const std::optional<net::Config> network = car_block::read_network(block);
    require(firmware && network);
    const car_block::Verdict verdict =
        car_block::read_car(block, firmware->grids, sensors, car.vehicle);
    require(verdict.refusal == car_block::Refusal::kNone);
    car.network = *network;
  }

  std::array<car_block::SensorMemory, kMostCars> sensors_;
  std::array<Car, kMostCars> cars_;
};

}  // namespace

std::span<const Car> cars() {
  static const Fleet fleet;
  return fleet.cars();
}

const Car& car(std::string_view name) {
  const auto all = cars();
  const auto found =
      std::ranges::find_if(all, [&](const Car& each) { return each.vehicle.name == name; });
  require(found != all.end());
  return *found;
}

}  // namespace iog::vehicles
