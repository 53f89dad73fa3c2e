#include "tools/identity/unit_mix.hpp"

#include <algorithm>

namespace iog::tools {
namespace {

constexpr std::uint64_t kFewest = 25;  // steps
constexpr std::uint64_t kOfMany = 4;
constexpr std::uint64_t kLongestUs = 20'000;  // from packet to packet of a unit that turns

bool is_same_scan(const lidar::PacketInfo& one, const lidar::PacketInfo& other) {
  return one.scan_number == other.scan_number && one.sweep.begin_us == other.sweep.begin_us;
}

}  // namespace

// Sectors as of LostPackets. A clock of the hour begins anew.
bool UnitMix::is_next(const Seen& before, const Seen& packet) {
  if (before.source_ipv4 != packet.source_ipv4 || before.ticks_per_turn != packet.ticks_per_turn) {
    return false;
  }
  const std::uint32_t turn = packet.ticks_per_turn;
  if (turn == 0) {
    const auto number = static_cast<std::uint16_t>(before.info.scan_number + 1);
    return is_same_scan(before.info, packet.info) || number == packet.info.scan_number;
  }
  const std::uint64_t hour_us = packet.info.sweep.is_of_hour ? 3'600'000'000 : 0;
  const std::uint64_t from_us = before.info.sweep.begin_us;
  const std::uint64_t to_us = packet.info.sweep.begin_us;
  const std::uint64_t since_us = to_us + (to_us < from_us ? hour_us : 0) - from_us;
  const std::uint32_t width = before.info.sector.width_ticks;
  const std::uint32_t gained =
      (before.info.sector.first_ticks + turn - packet.info.sector.first_ticks) % turn;
  return since_us <= kLongestUs && width / 2 < gained && gained <= width + width / 4;
}

void UnitMix::add(const lidar::PacketInfo& info, std::uint32_t source_ipv4,
                  std::uint32_t ticks_per_turn) {
  const Seen packet{.source_ipv4 = source_ipv4, .ticks_per_turn = ticks_per_turn, .info = info};
  if (ticks_per_turn > 0 &&
      std::ranges::any_of(seen_, [&](const Seen& seen) { return is_next(packet, seen); })) {
    return;  // the network has let another one overtake it
  }
  const auto before =
      std::ranges::find_if(seen_, [&](const Seen& seen) { return is_next(seen, packet); });
  const bool is_last = before == seen_.begin();
  const bool is_step = !is_last || ticks_per_turn > 0 || !is_same_scan(before->info, info);
  steps_ += is_step ? 1U : 0U;
  switches_ += is_step && !is_last && before != seen_.end() ? 1U : 0U;
  std::rotate(seen_.begin(), before == seen_.end() ? before - 1 : before,
              before == seen_.end() ? before : before + 1);
  seen_.front() = packet;
}

bool UnitMix::is_of_several() const { return steps_ >= kFewest && kOfMany * switches_ > steps_; }

}  // namespace iog::tools
