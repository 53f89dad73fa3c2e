#include "tools/simulate/mixed_drive.hpp"

#include <algorithm>
#include <cstdint>
#include <utility>

namespace iog::tools {

PartOfCar::PartOfCar(const CatalogueEntry& car, bool turning)
    : vehicle_(*car.vehicle), entry_(car) {
  for (std::size_t i = 0; i < car.sensors.size(); ++i) {
    if ((sender_of(car.sensors[i]) != nullptr) == turning) {
      configs_.push_back(car.sensors[i]);
      sensors_.push_back(car.vehicle->sensors[i]);
    }
  }
  vehicle_.sensors = sensors_;
  entry_.vehicle = &vehicle_;
  entry_.sensors = configs_;
}

MixedDrive::MixedDrive(const CatalogueEntry& car, std::uint64_t seed, std::uint32_t seconds,
                       const SceneEntry& scene)
    : standing_(car, false),
      turning_(car, true),
      lux_(standing_.entry(), seed, seconds, scene),
      turns_(turning_.entry(), seed, seconds, scene) {}

void MixedDrive::move_to(std::uint32_t frame) {
  frame_ = frame;
  lux_.move_to(frame);
}

void MixedDrive::append_turns(std::uint64_t until_us, std::vector<CapturedDatagram>& datagrams) {
  while (next_turn_ < turns_.frame_count() &&
         (waiting_.empty() || waiting_.back().time_us < until_us)) {
    turns_.move_to(next_turn_++);
    for (CapturedDatagram& packet : turns_.datagrams()) {
      waiting_.push_back(std::move(packet));
    }
  }
  while (!waiting_.empty() && waiting_.front().time_us < until_us) {
    datagrams.push_back(std::move(waiting_.front()));
    waiting_.pop_front();
  }
}

std::vector<CapturedDatagram> MixedDrive::datagrams() {
  std::vector<CapturedDatagram> datagrams = lux_.datagrams();
  const bool is_last = frame_ + 1 == frame_count();
  append_turns(is_last ? UINT64_MAX : datagrams.back().time_us, datagrams);
  std::ranges::stable_sort(datagrams, {}, &CapturedDatagram::time_us);
  return datagrams;
}

}  // namespace iog::tools
