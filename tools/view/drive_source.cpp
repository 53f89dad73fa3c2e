// The drive that is made up as it goes.
#include <memory>
#include <optional>
#include <utility>
#include <vector>

#include "tools/program/interrupt.hpp"
#include "tools/replay/pace.hpp"
#include "tools/simulate/drives/drive.hpp"
#include "tools/simulate/drives/pose_source.hpp"
#include "tools/simulate/truth/true_occupancy.hpp"
#include "tools/vehicles/vehicle_catalogue.hpp"
#include "tools/view/sensor_target.hpp"
#include "tools/view/sources.hpp"

namespace iog::tools::view {
namespace {

// A drive as it is shown, frame by frame in their order. A vehicle without classes has no use for
// poses, and the world stands still during its scans.
class ShownDrive {
 public:
  ShownDrive(const CatalogueEntry& car, std::uint64_t seed, const SceneEntry& scene)
      : car_(&car),
        has_classes_(vehicle::have_classes(car.vehicle->grids)),
        drive_(car, seed, Drive::kMaxSeconds, scene,
               has_classes_ ? Motion::kContinuous : Motion::kStepwise) {
    if (has_classes_) {
      poses_.emplace(simulated_poses(drive_.scene(), {}, seed, Drive::kMaxSeconds),
                     car.vehicle->poses.udp_port);
    }
  }

  [[nodiscard]] std::uint32_t frame_count() const { return drive_.frame_count(); }
  [[nodiscard]] std::uint64_t frame_us() const { return 1'000'000 / drive_.frames_per_second(); }

  [[nodiscard]] std::vector<CapturedDatagram> datagrams(std::uint32_t frame) {
    std::vector<CapturedDatagram> datagrams = drive_.datagrams(frame);
    return poses_ ? with_poses(std::move(datagrams), *poses_) : datagrams;
  }

  // At the end of that frame.
  [[nodiscard]] Truth truth(std::uint32_t frame) const {
    const EgoPose ego = drive_.ego(frame);
    Truth truth{.occupied = true_occupancy(ego, drive_.solids(frame), *car_->description)};
    if (has_classes_) {
      truth.area = cells_around(ego, car_->description->grid.cell_m);
      truth.classes =
          true_classes(drive_.scene(), drive_.true_at_s(frame), truth.area, *car_->description);
    }
    return truth;
  }

 private:
  const CatalogueEntry* car_;
  bool has_classes_;
  Drive drive_;
  std::optional<PoseFeed> poses_;
};

class DriveSource : public Source {
 public:
  DriveSource(const std::string& scene, const std::string& vehicle, std::uint64_t seed)
      : car_(&find_vehicle(vehicle)), scene_(&find_scene(scene)), seed_(seed), next_(next()) {}

  [[nodiscard]] std::string kind() const override { return "drive"; }

  void run(Viewer& viewer) override {
    const auto target = std::make_unique<SensorTarget>(*car_, viewer);  // too large for the stack
    Pace pace(1);
    for (std::uint64_t round_us = 0; !was_interrupted(); round_us += kRoundUs) {
      const std::unique_ptr<ShownDrive> drive = std::move(next_);
      for (std::uint32_t frame = 0; frame < drive->frame_count() && !was_interrupted(); ++frame) {
        pace.wait_for(round_us + frame * drive->frame_us());
        play(*drive, frame, round_us, *target);
        viewer.tend();
      }
      next_ = next();
    }
  }

 private:
  static constexpr std::uint64_t kRoundUs = 1'000'000 * std::uint64_t{Drive::kMaxSeconds};

  // Another drive, as long as one can be, with another seed.
  [[nodiscard]] std::unique_ptr<ShownDrive> next() {
    return std::make_unique<ShownDrive>(*car_, seed_++, *scene_);
  }

  static void play(ShownDrive& drive, std::uint32_t frame, std::uint64_t round_us,
                   SensorTarget& target) {
    std::vector<CapturedDatagram> packets = drive.datagrams(frame);
    const auto truth = std::make_shared<const Truth>(drive.truth(frame));
    for (CapturedDatagram& packet : packets) {
      packet.time_us += round_us;
      target.take(packet, truth);
    }
  }

  const CatalogueEntry* car_;
  const SceneEntry* scene_;
  std::uint64_t seed_;
  std::unique_ptr<ShownDrive>
      next_;  // made at once, so that a wrong name is told before a page opens
};

}  // namespace

std::unique_ptr<Source> make_drive_source(const std::string& scene, const std::string& vehicle,
                                          std::uint64_t seed) {
  return std::make_unique<DriveSource>(scene, vehicle, seed);
}

}  // namespace iog::tools::view
