// What the classes say where the world is not flat: each unit through the simulated hills, with and
// without the keys that let it follow the ground and open it only from below, return by return
// against what is true.
#include <array>
#include <cstdint>
#include <memory>
#include <span>
#include <string_view>
#include <utility>
#include <vector>

#include "lab/evaluation/true_things.hpp"
#include "lab/experiments/experiments.hpp"
#include "lab/experiments/hills/scored_returns.hpp"
#include "tools/formats/capture/made_capture.hpp"
#include "tools/simulate/drives/pose_source.hpp"

namespace iog::lab {
namespace {

// Nothing was tuned on the seeds from here on. An act of the hills takes 24 s.
constexpr std::uint64_t kSeedsBefore = 30;
constexpr std::uint32_t kSeconds = 12;
constexpr std::uint64_t kWarmUpUs = 1'000'000;

constexpr std::array<std::string_view, 9> kCars{"roof_vlp16",    "roof_vlp32c", "roof_hdl32e",
                                                "roof_xt32",     "roof_os1_64", "roof_hdl64e",
                                                "roof_pandar64", "roof_ld_mrs", "reference_car"};

struct Setting {
  std::string_view name;
  Keys keys;
};

// docs/vehicles.md has the values that are for units that turn and those for others.
constexpr vehicle::GroundLimits kGround{.low_mm = 220, .top_mm = 2'200};
constexpr std::array kOfUnitsThatTurn{
    Setting{"height band", {}},
    Setting{"both keys", {kGround, {.low_mm = 600, .tall_mm = 400}}},
};
constexpr std::array kOfOthers{
    Setting{"height band", {}},
    Setting{"both keys", {{}, {.low_mm = 800, .tall_mm = 0}}},
};

// By What.
constexpr std::array<std::string_view, 4> kWhatNames{"road", "beside the road", "standing",
                                                     "moving"};

void add_scores(std::string_view car, std::uint64_t seed, std::string_view setting,
                const ReturnScores& scores, Table& table) {
  for (const auto& [on, ranges] : scores) {
    for (std::size_t range = 0; range < ranges.size(); ++range) {
      const SaidCounts& said = ranges[range];
      if (said.all() > 0) {
        table.row(car, seed, setting, kWhatNames[static_cast<std::size_t>(on.what)],
                  kMaterialNames[static_cast<std::size_t>(on.material)],
                  range == 0 ? 0.0 : kReturnRangesM[range - 1], on.is_marked ? 1 : 0, said.unknown,
                  said.free, said.moving, said.standing, said.open);
      }
    }
  }
}

// The car leans on its springs, as in docs/drives.md.
void add_drive(const tools::CatalogueEntry& car, std::uint64_t seed, std::uint32_t seconds,
               Table& returns, Table& drives) {
  tools::Scene scene = tools::find_scene("hills").make(seed, seconds);
  scene.attitude.emplace(seed);
  tools::Drive drive(car, seed, seconds, std::move(scene), tools::Motion::kContinuous);
  tools::PoseFeed poses(tools::simulated_poses(drive.scene(), {}, seed, seconds + 0.1));
  const bool turns = lidar::turns(car.vehicle->sensors.front().format);
  const std::span<const Setting> settings =
      turns ? std::span<const Setting>(kOfUnitsThatTurn) : std::span<const Setting>(kOfOthers);
  std::vector<std::unique_ptr<Listener>> listeners;
  for (const Setting& setting : settings) {
    listeners.push_back(
        std::make_unique<Listener>(*car.vehicle, setting.keys, tools::kDriveStartUs + kWarmUpUs));
  }
  const KeyedCar synchronised(*car.vehicle, {});
  Seen seen(synchronised.vehicle(), drive.scene());
  for (std::uint32_t frame = 0; frame < drive.frame_count(); ++frame) {
    seen.look(drive, frame);
    for (tools::SimulatedPacket& simulated : drive.packets(frame)) {
      const SeenPacket packet = seen.of(std::move(simulated));
      const auto due = poses.take_until(packet.datagram.time_us);
      for (const auto& listener : listeners) {
        for (const tools::CapturedDatagram& pose : due) {
          listener->take(pose);
        }
        listener->take(packet);
      }
    }
  }
  for (std::size_t i = 0; i < settings.size(); ++i) {
    add_scores(car.vehicle->name, seed, settings[i].name, listeners[i]->scores(), returns);
    drives.row(car.vehicle->name, seed, settings[i].name, seconds, listeners[i]->packets_lost());
  }
}

}  // namespace

Tables hills_classes(const Input& input) {
  Table returns("hills_returns", {"car", "seed", "setting", "on", "material", "range_from_m",
                                  "is_marked", "unknown_returns", "free_returns", "moving_returns",
                                  "standing_returns", "open_returns"});
  Table drives("hills_drives", {"car", "seed", "setting", "seconds", "packets_not_placed"});
  for (const std::string_view car : kCars) {
    for (std::uint32_t drive = 0; drive < input.hills; ++drive) {
      const std::uint64_t seed = kSeedsBefore + input.seed + drive;
      add_drive(tools::find_vehicle(car), seed, kSeconds, returns, drives);
    }
  }
  return {std::move(returns), std::move(drives)};
}

}  // namespace iog::lab
