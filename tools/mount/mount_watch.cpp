#include "tools/mount/mount_watch.hpp"

#include <cmath>
#include <cstddef>

#include "tools/mount/mount_fit.hpp"
#include "tools/program/fixed.hpp"
#include "tools/program/table.hpp"

namespace iog::tools {
namespace {

constexpr std::size_t kFewestSeen = 10;
// Right mounts of recorded and simulated drives are within half of this. Roads fall to the side.
constexpr double kMostOffDeg = 1.5;
constexpr double kMostRolledDeg = 5;
constexpr double kMostOffM = 0.25;

bool is_off(const FittedValue& road, double by_file, double most) {
  return std::abs(road.value - by_file) > most + road.difference();
}

// Only what is off; empty: nothing is.
std::string words_of(const MountFit& fit, const description::MountConfig& mount) {
  if (fit.taken < kFewestSeen) {
    return {};
  }
  std::string words;
  const auto add = [&](const char* name, const FittedValue& road, double by_file, double most,
                       int places, const char* unit) {
    if (is_off(road, by_file, most)) {
      words += std::string(words.empty() ? "is off: its " : ", its ") + name + " by " +
               fixed(by_file - road.value, places) + unit;
    }
  };
  add("pitch", fit.pitch_deg, mount.pitch_deg, kMostOffDeg, 1, " degrees");
  add("roll", fit.roll_deg, mount.roll_deg, kMostRolledDeg, 1, " degrees");
  add("height", fit.z_m, mount.z_m, kMostOffM, 2, " m");
  return words.empty() ? words : words + "; `iog mount` finds it";
}

}  // namespace

MountWatch::MountWatch(const CatalogueEntry& car, std::uint64_t every) {
  for (std::size_t i = 0; i < car.sensors.size(); ++i) {
    if (lidar::turns(car.sensors[i].format)) {
      units_.emplace_back(&car.sensors[i], UnitTurns(car, i, every));
    }
  }
}

void MountWatch::take(const CapturedDatagram& datagram) {
  for (auto& [sensor, turns] : units_) {
    turns.take(datagram);
  }
}

std::string MountWatch::rows() {
  std::string text;
  for (auto& [sensor, turns] : units_) {
    turns.finish();
    const std::string words = turns.is_other_way_up()
                                  ? kOtherWayUp
                                  : words_of(fit_of(turns, {}, kFewestSeen), sensor->mount);
    text += row_if(!words.empty(), "MOUNT?",
                   "judging by the road, the mount of " + std::string(sensor->name) + " " + words);
  }
  return text;
}

}  // namespace iog::tools
