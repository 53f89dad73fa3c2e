// How the car moved, by the poses in its recording: whether its springs were at rest.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

namespace iog::tools {

enum class CarState : std::uint8_t {
  kUnknown,  // no pose within a second
  kStands,   // slower than 2 m/s: one place of the road would be taken for all of them
  kLeans,    // it turns, brakes or gains speed by more than 1 m/s^2
  kDrives,
};
inline constexpr std::size_t kCarStateCount = 4;

class MotionLog {
 public:
  // What comes to any port; what is no pose is left alone.
  void add(std::uint64_t time_us, std::span<const std::byte> payload);

  [[nodiscard]] bool is_empty() const { return samples_.empty(); }
  // Once all have been added, in whatever order.
  void sort();
  [[nodiscard]] CarState at(std::uint64_t time_us) const;

 private:
  struct Sample {
    std::uint64_t time_us;
    double speed;     // m/s
    double yaw_rate;  // rad/s
  };
  std::vector<Sample> samples_;
};

}  // namespace iog::tools
