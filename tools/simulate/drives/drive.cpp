#include "tools/simulate/drives/drive.hpp"

#include <algorithm>
#include <numeric>
#include <utility>

#include "tools/formats/lux/lux_scan.hpp"
#include "tools/simulate/scanners/lux_burst.hpp"
#include "tools/simulate/scanners/lux_unit.hpp"
#include "tools/simulate/scanners/spinning_unit.hpp"

namespace iog::tools {
namespace {

constexpr std::uint64_t kPhaseStream = 7;

// One somewhere in each of as many parts of the period as there are LUX, in random order: so the
// scans of a frame follow one another within one period, and no two end together.
std::vector<std::uint64_t> phases_of(std::size_t units, std::uint64_t seed) {
  Random random(seed, kPhaseStream);
  std::vector<std::size_t> order(units);
  std::iota(order.begin(), order.end(), std::size_t{0});
  for (std::size_t last = units; last > 1; --last) {
    std::swap(order[last - 1], order[random.below(last)]);
  }
  std::vector<std::uint64_t> phases;
  for (const std::size_t part : order) {
    const double share = static_cast<double>(part) + random.between(0.1, 0.9);
    phases.push_back(static_cast<std::uint64_t>(share * kLuxPeriodUs) / units);
  }
  return phases;
}

std::uint64_t time_of(const SimulatedPacket& packet) { return packet.datagram.time_us; }

std::vector<std::unique_ptr<Unit>> units_of(const CatalogueEntry& car, std::uint64_t seed,
                                            Motion motion) {
  std::size_t lux = 0;
  for (const description::SensorConfig& sensor : car.sensors) {
    lux += sends_lux_scans(sensor.format) ? 1U : 0U;
  }
  const std::vector<std::uint64_t> phases_us =
      motion == Motion::kContinuous ? phases_of(lux, seed) : std::vector<std::uint64_t>(lux);
  std::vector<std::unique_ptr<Unit>> units;
  lux = 0;
  for (const description::SensorConfig& sensor : car.sensors) {
    if (sends_lux_scans(sensor.format)) {
      units.push_back(
          std::make_unique<LuxUnit>(UnitOfDrive{&sensor, lux, seed, motion}, phases_us[lux]));
      ++lux;
    } else {
      units.push_back(std::make_unique<SpinningUnit>(
          UnitOfDrive{&sensor, units.size() - lux, seed, motion}, encoder_of(sensor)));
    }
  }
  return units;
}

}  // namespace

Drive::Drive(const CatalogueEntry& car, std::uint64_t seed, std::uint32_t seconds,
             const SceneEntry& scene, Motion motion)
    : Drive(car, seed, seconds, scene.make(seed, seconds), motion) {}

Drive::Drive(const CatalogueEntry& car, std::uint64_t seed, std::uint32_t seconds, Scene scene,
             Motion motion)
    : scene_(std::move(scene)), motion_(motion), units_(units_of(car, seed, motion)) {
  for (const auto& unit : units_) {
    frames_per_second_ = std::max(frames_per_second_, unit->frames_per_second());
  }
  frame_count_ = seconds * frames_per_second_;
  for (const auto& unit : units_) {
    slow_count_ = is_slow(*unit) ? seconds * unit->frames_per_second() : slow_count_;
  }
}

std::uint64_t Drive::scan_end_us(std::size_t sensor, std::uint32_t frame) const {
  return units_[sensor]->frame_end_us(frame);
}

std::uint64_t Drive::frame_end_us(std::uint32_t frame) const {
  std::uint64_t last_us = 0;
  for (const auto& unit : units_) {
    last_us = std::max(last_us, is_slow(*unit) ? 0 : unit->frame_end_us(frame));
  }
  return last_us;
}

double Drive::true_at_s(std::uint32_t frame) const {
  if (motion_ == Motion::kContinuous) {
    return static_cast<double>(frame_end_us(frame)) / 1e6;
  }
  const auto first =
      std::ranges::find_if(units_, [&](const auto& unit) { return !is_slow(*unit); });
  return (*first)->still_at_s(frame);
}

std::vector<Solid> Drive::solids(std::uint32_t frame) const {
  std::vector<Solid> solids;
  scene_.append_seen_at(true_at_s(frame), solids);
  return solids;
}

void Drive::append_slow_units(std::uint64_t until_us, std::vector<SimulatedPacket>& packets) {
  while (next_slow_ < slow_count_ && (waiting_.empty() || time_of(waiting_.back()) < until_us)) {
    std::vector<SimulatedPacket> turn;
    for (const auto& unit : units_) {
      if (is_slow(*unit)) {
        unit->append_frame(scene_, next_slow_, turn);
      }
    }
    ++next_slow_;
    std::ranges::stable_sort(turn, {}, time_of);
    std::ranges::move(turn, std::back_inserter(waiting_));
  }
  while (!waiting_.empty() && time_of(waiting_.front()) < until_us) {
    packets.push_back(std::move(waiting_.front()));
    waiting_.pop_front();
  }
}

std::vector<SimulatedPacket> Drive::packets(std::uint32_t frame) {
  std::vector<SimulatedPacket> packets;
  for (const auto& unit : units_) {
    if (!is_slow(*unit)) {
      unit->append_frame(scene_, frame, packets);
    }
  }
  std::ranges::stable_sort(packets, {}, time_of);
  const bool is_last = frame + 1 == frame_count_;
  append_slow_units(is_last ? UINT64_MAX : time_of(packets.back()), packets);
  std::ranges::stable_sort(packets, {}, time_of);
  return packets;
}

std::vector<CapturedDatagram> datagrams_of(std::vector<SimulatedPacket>&& packets) {
  std::vector<CapturedDatagram> datagrams;
  datagrams.reserve(packets.size());
  for (SimulatedPacket& packet : packets) {
    datagrams.push_back(std::move(packet.datagram));
  }
  return datagrams;
}

}  // namespace iog::tools
