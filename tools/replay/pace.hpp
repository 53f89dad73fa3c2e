// Keeps the pace of a capture without drift: every packet has its absolute time.
#pragma once

#include <cstdint>

namespace iog::tools {

class Pace {
 public:
  // speed 1: as recorded, 2: twice as fast, 0: as fast as it goes.
  explicit Pace(double speed);

  // Waits for the time of a packet, in microseconds since the first one. Returns early when
  // interrupted.
  void wait_for(std::uint64_t time_us);

  // How far behind its time a packet has been sent at worst.
  [[nodiscard]] std::uint64_t worst_delay_us() const { return worst_delay_us_; }

 private:
  double speed_;
  bool has_started_ = false;
  std::uint64_t start_us_ = 0;
  std::uint64_t worst_delay_us_ = 0;
};

}  // namespace iog::tools
