// Clouds by rising stamps. A stamp that is far from the others may be wrong, so its cloud waits for
// the one after it.
#pragma once

#include <cstdint>
#include <optional>
#include <vector>

#include "tools/clouds/cloud_fields.hpp"

namespace iog::tools {

class CloudOrder {
 public:
  // Clouds of two units or of two threads of a driver are less far out of order than this.
  static constexpr std::uint64_t kMostDisorderUs = 1'000'000;

  // Returns the clouds that are now known to be in order. Skips a cloud that is a little older than
  // one before it, and a cloud whose stamp is far from those on both sides. A cloud is far from
  // another if it is more than kMostDisorderUs away. UsageError if several clouds are far behind
  // those before them.
  [[nodiscard]] std::vector<SeenCloud> take(SeenCloud&& cloud);

  // After the last cloud: the one that waits, unless it is far behind those before it.
  [[nodiscard]] std::vector<SeenCloud> finish();

  [[nodiscard]] std::uint64_t out_of_order() const { return out_of_order_; }
  [[nodiscard]] std::uint64_t furthest_back_us() const { return furthest_back_us_; }
  // Clouds whose stamp is far from those on both sides.
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
