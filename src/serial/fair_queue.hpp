// Selects the flow that sends next on a link that is too slow for all flows. The queue selects the
// flow that has received the least service relative to its weight (start-time fair queueing by
// Goyal, Vin and Cheng, IEEE/ACM Transactions on Networking 5, 1997). A flow neither gains nor
// loses service by being idle.
#pragma once

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>

namespace iog::serial {

template <std::size_t kFlows>
class FairQueue {
 public:
  // `weights` contains each flow's share of the link. Each weight must divide kUnit.
  static constexpr std::uint32_t kUnit = 24;

  constexpr explicit FairQueue(const std::array<std::uint32_t, kFlows>& weights)
      : weights_{weights} {}

  // Selects one of the waiting flows. If several waiting flows have received equally little
  // service, the queue selects the first one. If an idle flow has received less service than the
  // selected flow, its service is raised to the same value, so that idle flows cannot accumulate
  // credit.
  [[nodiscard]] std::optional<std::size_t> next(const std::array<bool, kFlows>& is_waiting) {
    std::optional<std::size_t> chosen;
    for (std::size_t flow = 0; flow < kFlows; ++flow) {
      if (is_waiting[flow] && (!chosen || service_[flow] < service_[*chosen])) {
        chosen = flow;
      }
    }
    for (std::size_t flow = 0; flow < kFlows && chosen; ++flow) {
      service_[flow] =
          is_waiting[flow] ? service_[flow] : std::max(service_[flow], service_[*chosen]);
    }
    return chosen;
  }

  // Charges the flow for `bytes` bytes sent.
  void charge(std::size_t flow, std::size_t bytes) {
    service_[flow] += static_cast<std::uint32_t>(bytes) * (kUnit / weights_[flow]);
    const std::uint32_t least = *std::ranges::min_element(service_);
    for (std::uint32_t& service : service_) {
      service -= least;  // only differences matter, so subtracting avoids overflow
    }
  }

 private:
  std::array<std::uint32_t, kFlows> weights_;
  std::array<std::uint32_t, kFlows> service_{};  // in bytes, times kUnit / weight
};

}  // namespace iog::serial
