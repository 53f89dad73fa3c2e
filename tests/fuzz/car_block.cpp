// The car of an image (car_block/car_block.hpp), and the tables that a firmware uses of it. The
// input is the content of the car's record, framed so that the checks behind its CRC are reached.
// Laws: reading it again comes to the same; what is accepted is what would be written, byte by
// byte, and is named by its CRC; points of every layer then have a fate.
#include "car_block/car_block.hpp"

#include <algorithm>
#include <array>
#include <memory>
#include <vector>

#include "car_block/content.hpp"
#include "fusion/frame_fusion.hpp"
#include "law.hpp"
#include "vehicles/cars.hpp"

namespace iog::fuzz {
namespace {

using car_block::kCarRecord;
using car_block::kRecordHeaderBytes;

class BlockBytes {
 public:
  BlockBytes(const vehicle::Vehicle& car, const net::Config& network) {
    car_block::write_block(car, network, writable());
  }
  void set_content(std::span<const std::byte> content) {
    const auto place = writable().subspan<kCarRecord.offset, kCarRecord.capacity>();
    std::ranges::fill(place, std::byte{0});
    std::ranges::copy(content, place.subspan(kRecordHeaderBytes).begin());
    car_block::frame_record(writable(), kCarRecord, content.size());
  }
  [[nodiscard]] car_block::Block block() const {
    return std::span<const std::byte>(bytes_).first<car_block::kBlockBytes>();
  }

 private:
  car_block::WritableBlock writable() { return std::span(bytes_).first<car_block::kBlockBytes>(); }

  std::vector<std::byte> bytes_ = std::vector<std::byte>(car_block::kBlockBytes);
};

// Near and far, to all sides, and one that is nowhere.
void add_points(const vehicle::Vehicle& car) {
  constexpr std::array<std::uint32_t, 4> kRangesMm{0, 1, 12'345, 200'000};
  const auto fusion = std::make_unique<fusion::FrameFusion>(car);
  for (const vehicle::Sensor& sensor : car.sensors) {
    const std::uint32_t ticks = sensor.azimuths.ticks_per_turn();
    for (std::uint32_t side = 0; side < 5; ++side) {
      for (std::uint8_t layer = 0; layer < sensor.layer_count; ++layer) {
        for (const std::uint32_t range_mm : kRangesMm) {
          const lidar::ScanPoint point{
              .range_mm = range_mm,
              .azimuth_ticks = static_cast<std::uint16_t>(std::min(ticks - 1, ticks / 4 * side)),
              .layer = layer};
          law(static_cast<std::size_t>(fusion->add(sensor, point)) < vehicle::kFateCount,
              "a point has a fate");
        }
      }
    }
  }
  fusion->finish();
}

}  // namespace

void check(std::span<const std::byte> content) {
  if (content.size() > kCarRecord.capacity - kRecordHeaderBytes) {
    return;
  }
  static const vehicles::Car& known = vehicles::cars()[0];
  static const auto memory = std::make_unique<car_block::SensorMemory>();
  BlockBytes bytes(known.vehicle, known.network);
  bytes.set_content(content);
  for (const vehicle::Grids grids :
       {vehicle::Grids::kIndexes, vehicle::Grids::kClasses, vehicle::Grids::kBoth}) {
    vehicle::Vehicle car;
    const car_block::Verdict verdict = car_block::read_car(bytes.block(), grids, *memory, car);
    law(!car_block::Words(verdict).view().empty(), "a verdict has words");
    const auto again = car_block::read_car(bytes.block(), grids, *memory, car);
    law(again.refusal == verdict.refusal && again.fault.field == verdict.fault.field,
        "a verdict is the same twice");
    if (verdict.refusal != car_block::Refusal::kNone) {
      continue;
    }
    law(car.id == car_block::identity_of(car), "a car is named by its CRC");
    const BlockBytes written(car, known.network);
    law(std::ranges::equal(written.block().subspan<kCarRecord.offset>(),
                           bytes.block().subspan<kCarRecord.offset>()),
        "what is accepted is what would be written");
    add_points(car);
  }
}

}  // namespace iog::fuzz
