// The clocks in a car's captures: that of the poses, and those of the sensors that the car's file
// calls synchronised with it. If they differ (TAI and UTC, GPS and UTC, a wrong year) no packet has
// a pose. The difference is reported.
#pragma once

#include <cstddef>
#include <cstdint>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "tools/formats/capture/clock_pace.hpp"
#include "tools/formats/capture/datagram.hpp"
#include "tools/identity/clock_step.hpp"
#include "tools/identity/lost_packets.hpp"
#include "tools/vehicles/named_senders.hpp"
#include "tools/vehicles/vehicle_catalogue.hpp"

namespace iog::tools {

// How much later `time_us` is than `since_us`; negative if it is earlier.
[[nodiscard]] inline std::int64_t microseconds_later(std::uint64_t time_us,
                                                     std::uint64_t since_us) {
  return static_cast<std::int64_t>(time_us - since_us);
}

// How far each clock is ahead of the capture's, us, by the time stamps in the datagrams.
class CarClocks {
 public:
  explicit CarClocks(const CatalogueEntry& car) : car_(&car) {}

  void add(const CapturedDatagram& datagram);

  // Poses are those of a log, whose clock is so far ahead: nothing shows when they came.
  void use_log(std::int64_t ahead_us);

  // Whether there is a pose, and enough of each sensor that has a clock.
  [[nodiscard]] bool are_known() const;
  [[nodiscard]] std::int64_t poses_us() const { return poses_us_.value_or(0); }
  // Of the first sensor that has a clock; 0 if there is none, or it is the capture's.
  [[nodiscard]] std::int64_t sensors_us() const;

  // "the packets are 37.000 s ahead of the poses; ..."; empty if poses and packets agree.
  [[nodiscard]] std::string words() const;
  // As of ClockPace, of the first sensor that has any.
  [[nodiscard]] std::string words_of_pace() const {
    std::string words;
    for (const auto& [sensor, pace] : paces_) {
      words = words.empty() ? pace.words(std::string(car_->sensors[sensor].name)) : words;
    }
    return words;
  }
  // That several units send to the port of a sensor whose address the car's file does not name;
  // how CaptureIdentity refuses those that do so from the begin.
  [[nodiscard]] std::string words_of_crowd() const {
    std::string words;
    for (const auto& [sensor, senders] : heard_) {
      words = words.empty() ? tools::words_of_crowd(car_->sensors[sensor], senders, false) : words;
    }
    return words;
  }
  // As of LostPackets, of each sensor that has any. Complete when everything has been read.
  [[nodiscard]] std::vector<std::string> words_of_lost() const;
  // That they have no time in common, with both spans.
  [[nodiscard]] std::string words_apart() const;

  struct Span {
    std::uint64_t first_us = ~std::uint64_t{0};
    std::uint64_t last_us = 0;
    void add(std::uint64_t time_us);
    [[nodiscard]] std::string words() const;
  };
  // Capture times.
  [[nodiscard]] const Span& packets() const { return packets_; }

 private:
  void add_pose(const CapturedDatagram& datagram);
  void add_packet(const CapturedDatagram& datagram, std::size_t sensor);
  [[nodiscard]] std::string words_of_step() const;

  const CatalogueEntry* car_;
  bool is_of_log_ = false;
  Span poses_;
  Span packets_;
  std::uint64_t first_pose_us_ = 0;  // by its own clock, and the last one's
  std::uint64_t last_pose_us_ = 0;
  std::optional<std::int64_t> poses_us_;
  std::map<std::size_t, std::vector<std::int64_t>> sensors_us_;  // by sensor
  std::map<std::size_t, ClockStep> steps_;
  ClockStep pose_step_;
  std::map<std::size_t, ClockPace> paces_;
  std::map<std::size_t, LostPackets> lost_;
  std::map<std::size_t, std::map<std::uint32_t, Heard>> heard_;  // by sensor, by source
};

}  // namespace iog::tools
