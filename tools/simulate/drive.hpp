// A simulated drive, frame by frame: the world at the end of each scan, and what the scanners send.
// The world stands still while they scan, and all scan at once; moving_drive.hpp has the other
// kind.
#pragma once

#include <cstdint>
#include <vector>

#include "tools/formats/capture/datagram.hpp"
#include "tools/formats/lux/lux_burst.hpp"
#include "tools/simulate/lux_scanner.hpp"
#include "tools/simulate/random.hpp"
#include "tools/simulate/scene_catalogue.hpp"
#include "tools/vehicles/vehicle_catalogue.hpp"

namespace iog::tools {

// One for each sensor of the car. UsageError if one of them is not a LUX.
[[nodiscard]] std::vector<LuxScanner> scanners_of(const CatalogueEntry& car);

// What is random in the echoes of one scan.
[[nodiscard]] Random noise_of_scan(std::uint64_t seed, std::uint32_t frame, std::size_t sensor);

class Drive {
 public:
  static constexpr std::uint32_t kFramesPerSecond = kLuxFramesPerSecond;
  static constexpr std::uint32_t kMaxSeconds = 600;

  // car outlives the drive. UsageError if one of its sensors is not a LUX. The same seed, car,
  // scene and length make the same drive. A longer drive begins in the same world, but with other
  // traffic.
  Drive(const CatalogueEntry& car, std::uint64_t seed, std::uint32_t seconds,
        const SceneEntry& scene = find_scene(kDefaultScene));

  [[nodiscard]] std::uint32_t frame_count() const { return frame_count_; }

  // Moves the world to the end of that frame's scan.
  void move_to(std::uint32_t frame);

  // The frame's datagrams, in the order of their times.
  [[nodiscard]] std::vector<CapturedDatagram> datagrams();

  [[nodiscard]] const EgoPose& ego() const { return ego_; }
  [[nodiscard]] const std::vector<Solid>& solids() const { return solids_; }

 private:
  const CatalogueEntry* car_;
  std::uint64_t seed_;
  std::uint32_t frame_count_;
  Scene scene_;
  std::vector<LuxScanner> scanners_;

  std::uint32_t frame_ = 0;
  EgoPose ego_;
  std::vector<Solid> solids_;
};

}  // namespace iog::tools
