// A simulated drive: what the scanners of a car send while it drives through a scene.
//
// A frame is a scan of the car's LUX, of which there are 25 a second; of a car whose units all turn
// it is a tenth of a second. Every frame is a function of seed, car, scene, length and motion.
#pragma once

#include <cstddef>
#include <cstdint>
#include <deque>
#include <memory>
#include <vector>

#include "tools/formats/capture/datagram.hpp"
#include "tools/simulate/scanners/unit.hpp"
#include "tools/simulate/scenes/scene_catalogue.hpp"
#include "tools/vehicles/vehicle_catalogue.hpp"

namespace iog::tools {

[[nodiscard]] std::vector<CapturedDatagram> datagrams_of(std::vector<SimulatedPacket>&& packets);

class Drive {
 public:
  static constexpr std::uint32_t kMaxSeconds = 600;

  // car outlives the drive. A longer drive begins in the same world, but with other traffic.
  Drive(const CatalogueEntry& car, std::uint64_t seed, std::uint32_t seconds,
        const SceneEntry& scene = find_scene(kDefaultScene), Motion motion = Motion::kStepwise);
  // In a scene that was made for a drive of that length.
  Drive(const CatalogueEntry& car, std::uint64_t seed, std::uint32_t seconds, Scene scene,
        Motion motion);

  [[nodiscard]] std::uint32_t frames_per_second() const { return frames_per_second_; }
  [[nodiscard]] std::uint32_t frame_count() const { return frame_count_; }
  [[nodiscard]] const Scene& scene() const { return scene_; }

  // The end of the sensor's own frame of that number, in microseconds of the drive. LUX in
  // continuous motion have phases: whole periods and a part of one, which differ by at least a
  // twentieth of a period divided by their number.
  [[nodiscard]] std::uint64_t scan_end_us(std::size_t sensor, std::uint32_t frame) const;

  // The last of these of a frame of the drive; it comes before the next frame's first.
  [[nodiscard]] std::uint64_t frame_end_us(std::uint32_t frame) const;

  // The second of the drive whose world is the frame's truth: in continuous motion that of its end.
  [[nodiscard]] double true_at_s(std::uint32_t frame) const;

  // The frame's packets in the order of their times. Of a car that also has units that turn: those
  // of the frame's LUX and what the others have sent by the last of these, with the last frame all
  // the rest; its frames have to be asked for in their order, each once.
  [[nodiscard]] std::vector<SimulatedPacket> packets(std::uint32_t frame);
  [[nodiscard]] std::vector<CapturedDatagram> datagrams(std::uint32_t frame) {
    return datagrams_of(packets(frame));
  }

  // Where the car is, and everything that may be seen from it, at true_at_s().
  [[nodiscard]] EgoPose ego(std::uint32_t frame) const { return scene_.ego_at(true_at_s(frame)); }
  [[nodiscard]] std::vector<Solid> solids(std::uint32_t frame) const;

 private:
  [[nodiscard]] bool is_slow(const Unit& unit) const {
    return unit.frames_per_second() < frames_per_second_;
  }
  void append_slow_units(std::uint64_t until_us, std::vector<SimulatedPacket>& packets);

  std::uint32_t frames_per_second_ = 0;
  std::uint32_t frame_count_ = 0;
  std::uint32_t slow_count_ = 0;  // frames of the units that turn beside LUX
  Scene scene_;
  Motion motion_;
  std::vector<std::unique_ptr<Unit>> units_;  // by sensor
  std::uint32_t next_slow_ = 0;
  std::deque<SimulatedPacket> waiting_;  // of slow frames that have begun
};

}  // namespace iog::tools
