#include "tools/mount/mount_watch.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <iomanip>
#include <sstream>

#include "tools/mount/mount_fit.hpp"
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

std::string words_of(const MountFit& fit, const description::MountConfig& mount) {
  if (fit.taken < kFewestSeen || !(is_off(fit.pitch_deg, mount.pitch_deg, kMostOffDeg) ||
                                   is_off(fit.roll_deg, mount.roll_deg, kMostRolledDeg) ||
                                   is_off(fit.z_m, mount.z_m, kMostOffM))) {
    return {};
  }
  std::ostringstream words;
  words << std::fixed << std::setprecision(1) << "is off by "
        << mount.pitch_deg - fit.pitch_deg.value << " degrees in pitch and "
        << mount.roll_deg - fit.roll_deg.value << " in roll, and its height by "
        << std::setprecision(2) << mount.z_m - fit.z_m.value << " m; `iog mount` finds it";
  return words.str();
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
    const MountFit fit = fit_of(turns.mounts(), turns.turns(), {}, kFewestSeen);
    const bool is_other_way_up =
        turns.turned_over() >= std::max(kFewestSeen, 5 * turns.mounts().size()) ||
        fit.z_m.value < 0;
    const std::string words = is_other_way_up ? "is the other way up: its roll_deg differs by 180"
                                              : words_of(fit, sensor->mount);
    text += row_if(!words.empty(), "MOUNT?",
                   "judging by the road, the mount of " + std::string(sensor->name) + " " + words);
  }
  return text;
}

}  // namespace iog::tools
