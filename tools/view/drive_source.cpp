// The drive that is made up as it goes.
#include <memory>
#include <vector>

#include "tools/program/interrupt.hpp"
#include "tools/replay/pace.hpp"
#include "tools/simulate/drive.hpp"
#include "tools/simulate/moving_drive.hpp"
#include "tools/simulate/pose_source.hpp"
#include "tools/simulate/truth.hpp"
#include "tools/vehicles/vehicle_catalogue.hpp"
#include "tools/view/sensor_target.hpp"
#include "tools/view/sources.hpp"

namespace iog::tools::view {
namespace {

// A drive as it is shown, frame by frame in their order.
class ShownDrive {
 public:
  virtual ~ShownDrive() = default;
  [[nodiscard]] virtual std::vector<CapturedDatagram> datagrams(std::uint32_t frame) = 0;
  // At the end of the frame whose datagrams were taken last.
  [[nodiscard]] virtual Truth truth() const = 0;
};

// The world stands still during a scan: a vehicle without classes has no use for poses.
class StandingDrive : public ShownDrive {
 public:
  StandingDrive(const CatalogueEntry& car, std::uint64_t seed, const SceneEntry& scene)
      : car_(&car), drive_(car, seed, Drive::kMaxSeconds, scene) {}

  [[nodiscard]] std::vector<CapturedDatagram> datagrams(std::uint32_t frame) override {
    drive_.move_to(frame);
    return drive_.datagrams();
  }
  [[nodiscard]] Truth truth() const override {
    return {.occupied = true_occupancy(drive_.ego(), drive_.solids(), *car_->description)};
  }

 private:
  const CatalogueEntry* car_;
  Drive drive_;
};

class PlacedDrive : public ShownDrive {
 public:
  PlacedDrive(const CatalogueEntry& car, std::uint64_t seed, const SceneEntry& scene)
      : car_(&car),
        drive_(car, seed, Drive::kMaxSeconds, scene),
        poses_(simulated_poses(drive_.scene(), {}, seed, Drive::kMaxSeconds),
               car.vehicle->poses.udp_port) {}

  [[nodiscard]] std::vector<CapturedDatagram> datagrams(std::uint32_t frame) override {
    time_s_ = static_cast<double>(drive_.frame_end_us(frame)) / 1e6;
    return with_poses(drive_.datagrams(frame), poses_);
  }
  [[nodiscard]] Truth truth() const override {
    const tools::Scene& scene = drive_.scene();
    const EgoPose ego = scene.ego_at(time_s_);
    std::vector<Solid> solids;
    scene.append_seen_at(time_s_, solids);
    const CellArea area = cells_around(ego);
    return {.occupied = true_occupancy(ego, solids, *car_->description),
            .area = area,
            .classes = true_classes(scene, time_s_, area, *car_->description)};
  }

 private:
  const CatalogueEntry* car_;
  MovingDrive drive_;
  PoseFeed poses_;
  double time_s_ = 0;
};

class DriveSource : public Source {
 public:
  DriveSource(const std::string& scene, const std::string& vehicle, std::uint64_t seed)
      : car_(&find_vehicle(vehicle)), scene_(&find_scene(scene)), seed_(seed), drive_(next()) {}

  [[nodiscard]] std::string kind() const override { return "drive"; }

  void run(Viewer& viewer) override {
    const auto target = std::make_unique<SensorTarget>(*car_, viewer);  // too large for the stack
    Pace pace(1);
    for (std::uint64_t frame = 0; !was_interrupted(); ++frame) {
      if (frame > 0 && frame % kFrames == 0) {
        drive_ = next();
      }
      pace.wait_for(frame * kFrameUs);
      play(frame, *target);
      viewer.tend();
    }
  }

 private:
  static constexpr std::uint64_t kFrameUs = 1'000'000 / Drive::kFramesPerSecond;
  static constexpr std::uint64_t kFrames =
      std::uint64_t{Drive::kFramesPerSecond} * Drive::kMaxSeconds;

  // Another drive, as long as one can be, with another seed.
  [[nodiscard]] std::unique_ptr<ShownDrive> next() {
    const std::uint64_t seed = seed_++;
    if (vehicle::have_classes(car_->vehicle->grids)) {
      return std::make_unique<PlacedDrive>(*car_, seed, *scene_);
    }
    return std::make_unique<StandingDrive>(*car_, seed, *scene_);
  }

  void play(std::uint64_t frame, SensorTarget& target) {
    std::vector<CapturedDatagram> packets =
        drive_->datagrams(static_cast<std::uint32_t>(frame % kFrames));
    const auto truth = std::make_shared<const Truth>(drive_->truth());
    for (CapturedDatagram& packet : packets) {
      packet.time_us += frame / kFrames * kFrames * kFrameUs;
      target.take(packet, truth);
    }
  }

  const CatalogueEntry* car_;
  const SceneEntry* scene_;
  std::uint64_t seed_;
  std::unique_ptr<ShownDrive> drive_;
};

}  // namespace

std::unique_ptr<Source> make_drive_source(const std::string& scene, const std::string& vehicle,
                                          std::uint64_t seed) {
  return std::make_unique<DriveSource>(scene, vehicle, seed);
}

}  // namespace iog::tools::view
