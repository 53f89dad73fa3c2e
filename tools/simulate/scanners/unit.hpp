// A simulated unit on a car: what it sends of each of its frames, which are a scan of its mirror or
// a turn of its head.
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "tools/car/description.hpp"
#include "tools/simulate/random.hpp"
#include "tools/simulate/scanners/point_truth.hpp"
#include "tools/simulate/world/scene.hpp"
#include "vehicle/vehicle.hpp"

namespace iog::tools {

enum class Motion : std::uint8_t {
  kStepwise,    // the world stands still during a frame
  kContinuous,  // each beam is sent from where the car is at its time, and meets things there
};

// What a unit has to know of the drive.
struct UnitOfDrive {
  const description::SensorConfig* sensor;
  std::size_t number;  // among the car's units of its kind: with a mirror, or with a head
  std::uint64_t seed;
  Motion motion;

  // What is random in the echoes of one frame.
  [[nodiscard]] Random noise_of(std::uint32_t frame) const {
    constexpr std::uint64_t kNoiseStreams = 1000;  // the world's own streams are below
    return Random(seed, kNoiseStreams + std::uint64_t{frame} * vehicle::kMaxSensors + number);
  }
};

class Unit {
 public:
  Unit() = default;
  Unit(const Unit&) = delete;
  Unit& operator=(const Unit&) = delete;
  virtual ~Unit() = default;

  [[nodiscard]] virtual std::uint32_t frames_per_second() const = 0;

  // When the frame is over, in microseconds of the drive.
  [[nodiscard]] virtual std::uint64_t frame_end_us(std::uint32_t frame) const = 0;

  // At which second of the drive the world stands still for the frame, if its motion is stepwise.
  [[nodiscard]] virtual double still_at_s(std::uint32_t frame) const = 0;

  // Appends the frame's packets in the order of their times.
  virtual void append_frame(const Scene& scene, std::uint32_t frame,
                            std::vector<SimulatedPacket>& packets) = 0;
};

}  // namespace iog::tools
