// Clouds by rising stamps. A stamp that is far from the others may be wrong, so its cloud waits for
// the one after it.
#pragma once

#include <cstdint>
#include <optional>
#include <vector>

#include "tools/clouds/cloud_fields.hpp"

namespace iog::tools {

// Times are those of SeenCloud::time_us, in microseconds since 1970.
class CloudOrder {
 public:
  // Clouds of two units or of two threads of a driver are less far out of order than this.
  static constexpr std::uint64_t kMostDisorderUs = 1'000'000;

  // The next cloud of a recording. Returns the clouds that are now known to be in order: none, one
  // or two, whose times do not fall. Skips a cloud that is a little older than one before it, and a
  // cloud whose stamp is far from those on both sides. A cloud is far from another if it is more
  // than kMostDisorderUs away. UsageError if several clouds are far behind those before them.
  [[nodiscard]] std::vector<SeenCloud> take(SeenCloud&& cloud);

  // After the last cloud: returns the one that waits, unless it is far behind those before it.
  [[nodiscard]] std::vector<SeenCloud> finish();

  // Clouds that were skipped because they are older than one before them.
  [[nodiscard]] std::uint64_t out_of_order() const { return out_of_order_; }
  // How much older the oldest of these is than the newest cloud before it; 0: there are none.
  [[nodiscard]] std::uint64_t furthest_back_us() const { return furthest_back_us_; }
  // Clouds that were skipped because their stamp is far from those on both sides.
  [[nodiscard]] std::uint64_t strays() const { return strays_; }

 private:
  void judge_waiting(const SeenCloud& next, std::vector<SeenCloud>& in_order);
  void release(SeenCloud&& cloud, std::vector<SeenCloud>& in_order);
  [[nodiscard]] bool is_far_behind(std::uint64_t time_us) const;

  std::uint64_t taken_ = 0;
  std::optional<std::uint64_t> newest_us_{};  // of those in order
  std::optional<SeenCloud> waiting_{};
  bool follows_stray_ = false;  // waiting_, or the cloud that is taken
  std::uint64_t out_of_order_ = 0;
  std::uint64_t furthest_back_us_ = 0;
  std::uint64_t strays_ = 0;
};

}  // namespace iog::tools
