// A simulated drive in which nothing waits: the car moves while its scanners sweep, each point is
// measured from where the car is at its own time, and every scanner has a phase of its own.
//
// A scan of 100 degrees takes 11.111 ms, from left to right; column i of its 201 columns is
// measured i / 200 of that after its begin. Its packets leave when it is over. Times are
// microseconds since the drive's begin, which is kDriveStartUs of the packets' clock.
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "tools/formats/capture/datagram.hpp"
#include "tools/simulate/drive.hpp"
#include "tools/simulate/lux_scanner.hpp"
#include "tools/simulate/scene_catalogue.hpp"
#include "tools/vehicles/vehicle_catalogue.hpp"

namespace iog::tools {

class MovingDrive {
 public:
  // As Drive: the same seed, car, scene and length make the same drive. UsageError if a sensor is
  // not a LUX.
  MovingDrive(const CatalogueEntry& car, std::uint64_t seed, std::uint32_t seconds,
              const SceneEntry& scene = find_scene(kDefaultScene));
  // In a scene that was made for a drive of that length.
  MovingDrive(const CatalogueEntry& car, std::uint64_t seed, std::uint32_t seconds, Scene scene);

  [[nodiscard]] std::uint32_t frame_count() const { return frame_count_; }
  [[nodiscard]] const Scene& scene() const { return scene_; }

  // The end of a sensor's scan of that frame: a whole number of periods and the sensor's phase,
  // which differ by at least a twentieth of a period divided by the number of sensors.
  [[nodiscard]] std::uint64_t scan_end_us(std::size_t sensor, std::uint32_t frame) const;

  // The end of the frame's last scan. Every scan of a frame ends before the next frame's first.
  [[nodiscard]] std::uint64_t frame_end_us(std::uint32_t frame) const;

  // The frame's datagrams, in the order of their times.
  [[nodiscard]] std::vector<CapturedDatagram> datagrams(std::uint32_t frame);

 private:
  [[nodiscard]] Sweep sweep_until(std::uint64_t end_us) const;

  const CatalogueEntry* car_;
  std::uint64_t seed_;
  std::uint32_t frame_count_;
  Scene scene_;
  std::vector<LuxScanner> scanners_;
  std::vector<std::uint64_t> phases_us_;  // by sensor
};

}  // namespace iog::tools
