// A simulated drive of a car whose scanners turn, ten times a second (an Ouster as it is set), and
// a frame is a tenth of a second. Packets come when they are full, as their units fill them, so one
// may belong to two turns. The world stands still during a frame.
#pragma once

#include <cstdint>
#include <memory>
#include <vector>

#include "tools/formats/capture/datagram.hpp"
#include "tools/simulate/scene_catalogue.hpp"
#include "tools/simulate/spinning_scanner.hpp"
#include "tools/simulate/spinning_sender.hpp"
#include "tools/vehicles/vehicle_catalogue.hpp"

namespace iog::tools {

// Whether all scanners of the car turn, or any.
[[nodiscard]] bool spins(const CatalogueEntry& car);
[[nodiscard]] bool spins_partly(const CatalogueEntry& car);

class SpinningDrive {
 public:
  static constexpr std::uint32_t kFramesPerSecond = kTurnsPerSecond;

  // As Drive: the same seed, car, scene and length make the same drive. Only for a car that
  // spins().
  SpinningDrive(const CatalogueEntry& car, std::uint64_t seed, std::uint32_t seconds,
                const SceneEntry& scene = find_scene(kDefaultScene));

  [[nodiscard]] std::uint32_t frame_count() const { return frame_count_; }

  // Moves the world to the middle of that frame.
  void move_to(std::uint32_t frame);

  // The packets that begin in the frame, in the order of their times.
  [[nodiscard]] std::vector<CapturedDatagram> datagrams();

  [[nodiscard]] const EgoPose& ego() const { return ego_; }
  [[nodiscard]] const std::vector<Solid>& solids() const { return solids_; }

 private:
  void append_packets(std::size_t sensor, std::vector<CapturedDatagram>& datagrams);

  const CatalogueEntry* car_;
  std::uint64_t seed_;
  std::uint32_t frame_count_;
  Scene scene_;
  std::vector<SpinningScanner> scanners_;
  std::vector<std::unique_ptr<SpinningSender>> senders_;

  std::uint32_t frame_ = 0;
  EgoPose ego_;
  std::vector<Solid> solids_;
};

}  // namespace iog::tools
