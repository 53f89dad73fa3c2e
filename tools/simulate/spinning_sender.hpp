// A simulated unit that turns: packets as it would send them.
#pragma once

#include <cstddef>
#include <cstdint>
#include <memory>
#include <vector>

#include "tools/simulate/random.hpp"
#include "tools/simulate/spinning_scanner.hpp"
#include "vehicle/description.hpp"

namespace iog::tools {

inline constexpr std::uint32_t kTurnsPerSecond = 10;

class SpinningSender {
 public:
  SpinningSender() = default;
  SpinningSender(const SpinningSender&) = delete;
  SpinningSender& operator=(const SpinningSender&) = delete;
  virtual ~SpinningSender() = default;

  // From one packet to the next.
  [[nodiscard]] virtual std::uint64_t packet_ns() const = 0;

  // The packet that begins so long after the drive did, each beam with one return. The drive begins
  // at kDriveStartUs of the unit's clock, with an hour. number: how many were sent before.
  [[nodiscard]] virtual std::vector<std::byte> packet(std::uint64_t begin_ns, std::uint64_t number,
                                                      const SpinningScanner& scanner,
                                                      Random& random) const = 0;
};

// Of the sensor, which outlives it; nullptr if it does not turn.
[[nodiscard]] std::unique_ptr<SpinningSender> sender_of(const vehicle::SensorConfig& config);

}  // namespace iog::tools
