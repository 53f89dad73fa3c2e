// Whether each sensor of a car sends all the time, and its scans fit into the car's frames.
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "tools/formats/capture/datagram.hpp"
#include "tools/mount/turn_cutter.hpp"
#include "tools/vehicles/vehicle_catalogue.hpp"

namespace iog::tools {

class SensorWatch {
 public:
  // The car outlives it.
  explicit SensorWatch(const CatalogueEntry& car);

  // The next datagram of the capture, of whatever port.
  void take(const CapturedDatagram& datagram);

  // A row for each sensor that is silent for a second or longer while others send. The capture is
  // over.
  [[nodiscard]] std::string rows_of_silence() const;

  // A row for each sensor of which more than a tenth of the packets came after their frame had
  // ended. fused: packets of each sensor that were fused; late: such packets of all sensors.
  [[nodiscard]] std::string rows_of_late(std::span<const std::uint64_t> fused,
                                         std::uint64_t late) const;

  // A row for each spinning unit whose turns are longer than a frame, if a turn of usual_turn_us()
  // would fit. The capture is over.
  [[nodiscard]] std::string rows_of_turns() const;

 private:
  // When something came: by the capture's clock, and by one that stands while no sensor sends.
  struct Instant {
    std::uint64_t capture_us = 0;
    std::uint64_t sending_us = 0;
  };
  struct Silence {
    Instant from;
    Instant to;
    [[nodiscard]] std::uint64_t length_us() const { return to.sending_us - from.sending_us; }
  };
  struct Scan {
    std::uint32_t number = 0;
    std::uint64_t first_us = 0;
    std::uint64_t last_us = 0;
  };
  // What came of a sensor.
  struct Log {
    std::optional<Instant> newest{};
    Silence longest{};
    // Of a unit that turns.
    std::optional<TurnCutter> cutter{};
    std::optional<std::uint64_t> turn_begin_us{};
    std::vector<std::uint64_t> turns_us{};  // how long they took, by when their packets came
    // Of a unit that does not turn.
    std::uint64_t packets = 0;  // sound ones
    std::optional<Scan> scan{};
    std::vector<std::uint64_t> lengths_us{};  // of scans, by when their packets came
    std::vector<std::uint64_t> periods_us{};  // from scan to scan
  };

  void take_turn(const lidar::PacketInfo& info, Log& log) const;
  void take_scan(const lidar::PacketInfo& info, Log& log) const;
  [[nodiscard]] std::string words_of_silence(const Log& log) const;
  [[nodiscard]] std::string cause_of_late(const Log& log) const;

  const CatalogueEntry* car_;
  std::vector<Log> logs_;  // in the order of the car's sensors
  std::optional<Instant> begin_;
  Instant now_;
};

}  // namespace iog::tools
