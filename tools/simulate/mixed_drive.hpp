// A simulated drive of a car with LUX and with scanners that turn: the LUX as in drive.hpp, the
// others as in spinning_drive.hpp, in one world. A frame is one of the LUX; a turn lasts for two
// and a half of them.
#pragma once

#include <cstdint>
#include <deque>
#include <vector>

#include "tools/simulate/drive.hpp"
#include "tools/simulate/spinning_drive.hpp"

namespace iog::tools {

// Some sensors of a car as a car of their own.
class PartOfCar {
 public:
  // turning: those that turn, or the others. car outlives it.
  PartOfCar(const CatalogueEntry& car, bool turning);
  PartOfCar(const PartOfCar&) = delete;
  PartOfCar& operator=(const PartOfCar&) = delete;

  [[nodiscard]] const CatalogueEntry& entry() const { return entry_; }

 private:
  std::vector<vehicle::SensorConfig> configs_;
  std::vector<vehicle::Sensor> sensors_;
  vehicle::Vehicle vehicle_;
  CatalogueEntry entry_;
};

class MixedDrive {
 public:
  static constexpr std::uint32_t kFramesPerSecond = Drive::kFramesPerSecond;

  // As Drive: the same seed, car, scene and length make the same drive.
  MixedDrive(const CatalogueEntry& car, std::uint64_t seed, std::uint32_t seconds,
             const SceneEntry& scene = find_scene(kDefaultScene));

  [[nodiscard]] std::uint32_t frame_count() const { return lux_.frame_count(); }

  // From frame 0 on, one after the other.
  void move_to(std::uint32_t frame);

  // Those of the frame's LUX, and what the others have sent by the last of these; with the last
  // frame, all the rest.
  [[nodiscard]] std::vector<CapturedDatagram> datagrams();

  [[nodiscard]] const EgoPose& ego() const { return lux_.ego(); }
  [[nodiscard]] const std::vector<Solid>& solids() const { return lux_.solids(); }

 private:
  void append_turns(std::uint64_t until_us, std::vector<CapturedDatagram>& datagrams);

  PartOfCar standing_;
  PartOfCar turning_;
  Drive lux_;
  SpinningDrive turns_;
  std::uint32_t frame_ = 0;
  std::uint32_t next_turn_ = 0;
  std::deque<CapturedDatagram> waiting_;  // of turns that have begun
};

}  // namespace iog::tools
