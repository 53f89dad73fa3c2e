#include "tools/identity/lost_packets.hpp"

#include <algorithm>
#include <cmath>
#include <span>
#include <utility>

#include "tools/program/table.hpp"

namespace iog::tools {
namespace {

constexpr std::uint64_t kPauseUs = 1'000'000;
constexpr std::uint64_t kFewest = 10;
constexpr std::uint64_t kOfManyPackets = 100;
constexpr std::uint64_t kOfMany = 20;
constexpr std::uint64_t kHalfOfFastestTurnUs = 25'000;
constexpr double kMost = 1e15;

}  // namespace

void LostPackets::add(const lidar::PacketInfo& info, std::uint32_t source_ipv4,
                      std::uint32_t ticks_per_turn) {
  // A clock of the hour begins anew.
  const std::uint64_t clock_us = info.sweep.is_of_hour ? 3'600'000'000 : 0;
  const auto later = [clock_us](std::uint64_t from_us, std::uint64_t to_us) {
    return to_us >= from_us ? to_us - from_us : to_us + clock_us - from_us;
  };
  const std::uint64_t now_us = info.sweep.begin_us;
  const std::uint64_t since_us = later(time_us_, now_us);
  const auto known = std::span(fingerprints_).first(std::min(packets_, fingerprints_.size()));
  if (std::ranges::find(known, info.fingerprint) != known.end()) {  // a copy
    return;
  }
  fingerprints_[packets_++ % fingerprints_.size()] = info.fingerprint;
  const bool is_overtaken = since_us > 0 && later(now_us, time_us_) <= kPauseUs;
  is_whole_ = is_whole_ && source_ipv4 == source_ipv4_;
  if (is_whole_ && is_overtaken) {
    ++overtaken_;
    return;
  }
  is_next_ = is_whole_ && since_us <= kPauseUs;
  if (ticks_per_turn > 0 && info.sector.width_ticks > 0) {
    add_turning(info, since_us, ticks_per_turn);
  } else if (ticks_per_turn == 0) {
    add_scan(info);
  }
  source_ipv4_ = source_ipv4;
  time_us_ = now_us;
  is_whole_ = true;
}

// The wire's sweeps are clockwise, and end where, counter-clockwise, their sector begins.
void LostPackets::add_turning(const lidar::PacketInfo& info, std::uint64_t since_us,
                              std::uint32_t turn) {
  const std::uint32_t first = info.sector.first_ticks;
  const std::uint32_t width = info.sector.width_ticks;
  const std::uint32_t gained = (std::exchange(at_ticks_, first) + turn - first) % turn;
  const auto direction = [turn](std::uint64_t ticks) { return ticks * kDirections / turn; };
  const std::uint64_t end = std::uint64_t{first} + width;
  for (std::size_t i = direction(first); i <= direction(end); ++i) {
    seen_[i % kDirections] = true;
  }
  ticks_per_turn_ = turn;
  // A unit that stands turns by less than half a packet, or back a little.
  const bool stands =
      2 * gained < width || (gained > turn / 8 * 7 && since_us < kHalfOfFastestTurnUs);
  if (!is_next_ || stands) {
    return;
  }
  if (gained <= width + width / 4) {
    ++steps_;
    turned_us_ += since_us;
    turned_ticks_ += gained;
    return;
  }
  const double packets = steps_ == 0 ? 0 : std::round(gained / step_ticks()) - 1;
  gaps_[{direction(end), direction(end + gained - width)}] += std::max(1.0, packets);
  if (turned_us_ > 0) {
    const double turned = static_cast<double>(since_us) * static_cast<double>(turned_ticks_) /
                          static_cast<double>(turned_us_);
    turns_missing_ +=
        static_cast<std::uint64_t>(std::max(0.0, std::round((turned - gained) / turn)));
  }
}

void LostPackets::add_scan(const lidar::PacketInfo& info) {
  const auto number = static_cast<std::uint16_t>(info.scan_number);
  const auto step = static_cast<std::uint16_t>(number - std::exchange(number_, number));
  if (step != 0 && width_ticks_ > 0) {
    const std::uint32_t scan_ticks = std::exchange(width_ticks_, 0U);
    if (damaged_scans_ > 0) {
      --damaged_scans_;
    } else {
      ++scans_[scan_ticks];
    }
    successors_ += step == 1 ? 1U : 0U;
    // A scan is longer than 10 ms.
    numbers_missing_ += is_next_ && step < kPauseUs / 10'000 ? step - 1U : 0U;
  }
  width_ticks_ += info.sector.width_ticks;
}

// Of gaps with a direction that no packet has, the field of view is the cause.
double LostPackets::packets_missing() const {
  std::array<std::size_t, 2 * kDirections + 1> unseen{};  // before each direction of two turns
  for (std::size_t i = 0; i + 1 < unseen.size(); ++i) {
    unseen[i + 1] = unseen[i] + (seen_[i % kDirections] ? 0U : 1U);
  }
  const double seen = 1 - static_cast<double>(unseen[kDirections]) / kDirections;
  double missing = turns_missing_ == 0 ? 0
                                       : static_cast<double>(turns_missing_ * ticks_per_turn_) *
                                             seen / step_ticks();
  for (const auto& [gap, packets] : gaps_) {
    missing += unseen[gap.second + 1] == unseen[gap.first] ? packets : 0;
  }
  return missing;
}

// A part of a scan is missing if many scans are wider.
double LostPackets::scans_missing(std::uint64_t came) const {
  std::uint32_t usual = 0;
  for (const auto& [width, count] : scans_) {
    usual = kOfMany * count >= came ? width : usual;
  }
  double missing = static_cast<double>(numbers_missing_);
  for (const auto& [width, count] : scans_) {
    if (width < usual) {
      missing += static_cast<double>(count) * (1 - static_cast<double>(width) / usual);
    }
  }
  // A unit whose numbers do not advance one by one counts otherwise.
  return kOfMany * successors_ < came ? 0 : missing;
}

std::string LostPackets::words(const std::string& name) const {
  const bool turns = ticks_per_turn_ > 0;
  std::uint64_t came = turns ? packets_ : 0;
  for (const auto& [width, count] : scans_) {
    came += count;
  }
  if (came == 0) {
    return {};
  }
  const double missing =
      (turns ? packets_missing() : scans_missing(came)) - static_cast<double>(overtaken_);
  const auto lost = static_cast<std::uint64_t>(std::lround(std::clamp(missing, 0.0, kMost)));
  const std::uint64_t all = came + (turns ? lost : numbers_missing_);
  if (lost < kFewest || kOfManyPackets * lost < all) {
    return {};
  }
  return "about " + std::to_string(lost) + " of " + std::to_string(all) +
         (turns ? " packets of " : " scans of ") + name + " (" + percent(lost, all) +
         " %) are missing, so the grid has gaps: check the network and the recording PC";
}

}  // namespace iog::tools
