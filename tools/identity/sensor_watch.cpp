#include "tools/identity/sensor_watch.hpp"

#include <algorithm>
#include <cmath>

#include "intake/packet.hpp"
#include "lidar/formats.hpp"
#include "tools/car/defaults.hpp"
#include "tools/program/fixed.hpp"
#include "tools/program/middle.hpp"
#include "tools/program/table.hpp"

namespace iog::tools {
namespace {

constexpr std::uint64_t kSilenceUs = 1'000'000;
constexpr std::uint64_t kOfManyLate = 10;
// Packets may be missing in one of them.
constexpr std::size_t kFewestTurns = 3;

std::string milliseconds(std::uint64_t micros) {
  return std::to_string((micros + 500) / 1000) + " ms";
}

// One and a half scans or turns, in whole milliseconds, as far as a car file may say.
std::string words_of_enough(std::uint64_t period_us) {
  constexpr std::uint64_t kMostUs = 1'000'000;
  const std::uint64_t enough_us = (period_us * 3 / 2 + 500) / 1000 * 1000;
  return ": set frame_period_us = " + std::to_string(std::min(enough_us, kMostUs)) +
         " in the car file";
}

}  // namespace

SensorWatch::SensorWatch(const CatalogueEntry& car) : car_(&car), logs_(car.sensors.size()) {
  for (std::size_t i = 0; i < logs_.size(); ++i) {
    if (lidar::turns(car.sensors[i].format)) {
      logs_[i].cutter.emplace(car.sensors[i].format);
    }
  }
}

// A pause of all sensors is one of the recording, so the clock of sending stands.
void SensorWatch::take(const CapturedDatagram& datagram) {
  const std::size_t sensor = sensor_of_port(*car_, datagram.destination.port);
  if (sensor == logs_.size()) {
    return;
  }
  const std::uint64_t before_us = begin_ ? now_.capture_us : datagram.time_us;
  const std::uint64_t step_us = std::max(datagram.time_us, before_us) - before_us;
  now_.capture_us = before_us + step_us;
  now_.sending_us += step_us < kSilenceUs ? step_us : 0;
  if (!begin_) {
    begin_ = now_;
  }
  Log& log = logs_[sensor];
  const Silence silence{.from = log.newest.value_or(*begin_), .to = now_};
  if (silence.length_us() > log.longest.length_us()) {
    log.longest = silence;
  }
  log.newest = now_;
  const vehicle::Sensor& unit = car_->vehicle->sensors[sensor];
  const intake::Packet packet = intake::Packet::decode(unit.format, datagram.payload, unit.unit());
  if (packet.is_sound()) {
    if (log.cutter) {
      take_turn(packet.info(), log);
    } else {
      take_scan(packet.info(), log);
    }
  }
}

void SensorWatch::take_turn(const lidar::PacketInfo& info, Log& log) const {
  if (log.cutter->ends_before(info) || !log.turn_begin_us) {
    if (log.turn_begin_us) {
      log.turns_us.push_back(now_.capture_us - *log.turn_begin_us);
    }
    log.turn_begin_us = now_.capture_us;
  }
}

void SensorWatch::take_scan(const lidar::PacketInfo& info, Log& log) const {
  ++log.packets;
  const std::uint32_t number = info.scan_number;
  if (!log.scan || log.scan->number != number) {
    if (log.scan) {
      log.lengths_us.push_back(log.scan->last_us - log.scan->first_us);
      log.periods_us.push_back(now_.capture_us - log.scan->first_us);
    }
    log.scan = {.number = number, .first_us = now_.capture_us, .last_us = 0};
  }
  log.scan->last_us = now_.capture_us;
}

// Seconds since the first packet of any sensor.
std::string SensorWatch::words_of_silence(const Log& log) const {
  if (!log.newest) {
    return begin_ ? "nothing" : "";
  }
  const Silence last{.from = *log.newest, .to = now_};
  const bool is_to_the_end = last.length_us() >= std::max(kSilenceUs, log.longest.length_us());
  const Silence& longest = is_to_the_end ? last : log.longest;
  if (longest.length_us() < kSilenceUs) {
    return {};
  }
  const auto seconds = [&](const Instant& instant) {
    return fixed(static_cast<double>(instant.capture_us - begin_->capture_us) / 1e6, 1) + " s";
  };
  return "nothing from " + seconds(longest.from) +
         (is_to_the_end ? " on" : " to " + seconds(longest.to));
}

std::string SensorWatch::rows_of_silence() const {
  std::string rows;
  for (std::size_t i = 0; i < logs_.size(); ++i) {
    const std::string words = words_of_silence(logs_[i]);
    rows +=
        row_if(!words.empty(), "SILENT?", std::string(car_->sensors[i].name) + " sends " + words);
  }
  return rows;
}

// A frame ends when its time is over, or with the next scan of a sensor.
std::string SensorWatch::cause_of_late(const Log& log) const {
  const std::uint64_t frame_us = car_->vehicle->frame_period_us;
  const std::uint64_t scan_us = log.lengths_us.empty() ? 0 : middle_value_of(log.lengths_us);
  if (scan_us > frame_us) {
    return ": a scan lasts " + milliseconds(scan_us) + ", and a frame ends after " +
           milliseconds(frame_us) + words_of_enough(middle_value_of(log.periods_us));
  }
  return logs_.size() > 1 ? ": the next scan of another sensor ends the frame" : "";
}

// A car file may say a part of a turn instead, as the tracker needs of dense units.
std::string SensorWatch::rows_of_turns() const {
  const std::uint64_t frame_us = car_->vehicle->frame_period_us;
  std::string rows;
  for (std::size_t i = 0; i < logs_.size(); ++i) {
    const description::SensorConfig& sensor = car_->sensors[i];
    const std::vector<std::uint64_t>& turns_us = logs_[i].turns_us;
    const std::uint64_t turn_us = turns_us.size() < kFewestTurns ? 0 : middle_value_of(turns_us);
    rows +=
        row_if(turn_us > frame_us && frame_us >= description::usual_turn_us(sensor), "PARTIAL?",
               "a turn of " + std::string(sensor.name) + " takes " + milliseconds(turn_us) +
                   ", and a frame ends after " + milliseconds(frame_us) + words_of_enough(turn_us));
  }
  return rows;
}

std::string SensorWatch::rows_of_late(std::span<const std::uint64_t> fused,
                                      std::uint64_t late) const {
  std::string rows;
  for (std::size_t i = 0; i < logs_.size(); ++i) {
    const std::uint64_t packets = logs_[i].packets;
    const std::uint64_t its = std::min(late, packets - std::min(packets, fused[i]));
    rows += row_if(kOfManyLate * its > packets, "LATE?",
                   std::to_string(its) + " of " + std::to_string(packets) + " packets of " +
                       std::string(car_->sensors[i].name) + " come after their frame has ended" +
                       cause_of_late(logs_[i]));
  }
  return rows;
}

}  // namespace iog::tools
