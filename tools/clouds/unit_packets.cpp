#include "tools/clouds/unit_packets.hpp"

#include <algorithm>
#include <cmath>
#include <type_traits>

#include "lidar/formats.hpp"
#include "numeric/division.hpp"
#include "numeric/elementary.hpp"
#include "tools/formats/capture/made_capture.hpp"

namespace iog::tools {
namespace {

// Lasers look up to 30 degrees to the side, and channels a little: so far ahead of the rear may a
// point of the next turn be fired.
constexpr double kSeamTurns = 0.15;

constexpr std::size_t kChannels = lidar::VelodynePacket::kPointsPerBlock;

double part_of_turn(double turns) { return turns - std::floor(turns); }

std::uint16_t ticks_of(double turns) {
  constexpr std::int32_t kTurn = lidar::VelodynePacket::kTicksPerTurn;
  return static_cast<std::uint16_t>(numeric::round(part_of_turn(turns) * kTurn) % kTurn);
}

}  // namespace

const lidar::VelodyneUnit* velodyne_unit_of(lidar::Format format) {
  const lidar::VelodyneUnit* unit = nullptr;
  lidar::with_decoder(format, [&]<typename Decoder>(std::type_identity<Decoder> /*which*/) {
    if constexpr (std::is_base_of_v<lidar::VelodynePacket, Decoder>) {
      unit = &Decoder::unit();
    }
  });
  return unit;
}

// The grid of firings begins when the first turn does. Packets before it are of lasers that look to
// the side.
UnitPackets::UnitPackets(const description::SensorConfig& sensor, const Head& head)
    : sensor_(&sensor),
      head_(&head),
      unit_(velodyne_unit_of(sensor.format)),
      lasers_(sensor),
      channels_(unit_->layers),
      block_us_(unit_->block_ns / 1000.0),
      firings_(static_cast<std::int64_t>(lidar::VelodynePacket::kBlocks / unit_->banks)),
      begin_us_(head.time_at(static_cast<double>(head.first().turn) - 0.5)) {
  for (std::size_t place = 0; place < kChannels * unit_->banks; ++place) {
    const std::size_t channel = place % kChannels;
    channels_[place % unit_->layers].push_back(
        {.number = place,
         .fires_us =
             block_us_ * unit_->fires_after(place / kChannels, channel) / unit_->block_parts,
         .right = static_cast<double>(unit_->azimuth_offsets[channel]) /
                  lidar::VelodynePacket::kTicksPerTurn});
  }
}

// A turn begins and ends where its head looks to the rear.
double UnitPackets::seen_at_us(std::size_t turn, double right) const {
  return head_->time_at(static_cast<double>(turn) + right - std::floor(right + 0.5));
}

std::int64_t UnitPackets::packet_at(double turns) const {
  return static_cast<std::int64_t>(std::floor((head_->time_at(turns) - begin_us_) /
                                              (block_us_ * static_cast<double>(firings_))));
}

// When a point was seen depends on where it was then, and on its laser. Each round comes nearer by
// the ratio of the car's speed to that of the beam's end.
std::optional<LaserPoint> UnitPackets::seen_near(double at_us, std::size_t turn,
                                                 const CloudPoint& point,
                                                 const PlaceAt& place_at) const {
  constexpr int kRounds = 5;
  constexpr double kSameUs = 2;
  std::optional<LaserPoint> its;
  for (int round = 0; round < kRounds; ++round) {
    const CloudPoint there = place_at(point, static_cast<double>(head_->first().time_us) + at_us);
    its = lasers_.laser_of(there.x, there.y, there.z);
    const double seen_us = its ? seen_at_us(turn, its->right) : at_us;
    if (std::abs(seen_us - at_us) < kSameUs) {
      break;
    }
    at_us = seen_us;
  }
  return its;
}

// To the rear a point may be of either end of the turn, if it was moved; it is of that which a
// laser explains better.
std::optional<LaserPoint> UnitPackets::seen(std::size_t turn, const CloudPoint& point,
                                            const PlaceAt& place_at) const {
  const double right = -std::atan2(point.y, point.x) / (2 * numeric::kPi);
  const auto near = [&](double guess) {
    return seen_near(head_->time_at(static_cast<double>(turn) + guess), turn, point, place_at);
  };
  const std::optional<LaserPoint> its = near(right);
  if (std::abs(right) < 0.5 - kSeamTurns) {
    return its;
  }
  const std::optional<LaserPoint> other = near(right < 0 ? right + 1 : right - 1);
  return !its || (other && other->off_m < its->off_m) ? other : its;
}

// With the azimuths of its blocks, and no returns yet.
VelodyneBlocks& UnitPackets::packet(std::int64_t number) {
  const auto [found, is_new] = packets_.try_emplace(number);
  if (is_new) {
    for (std::size_t block = 0; block < found->second.size(); ++block) {
      const std::int64_t firing =
          number * firings_ + static_cast<std::int64_t>(block / unit_->banks);
      found->second[block].azimuth_ticks =
          ticks_of(head_->turns_at(begin_us_ + static_cast<double>(firing) * block_us_));
    }
  }
  return found->second;
}

// Of that firing of the whole drive.
UnitPackets::Slot UnitPackets::slot_of(const Channel& channel, std::int64_t firing) const {
  const std::int64_t number = numeric::div_floor(firing, firings_);
  const auto first_block = static_cast<std::size_t>(firing - number * firings_) * unit_->banks;
  return {.packet = number,
          .block = first_block + channel.number / kChannels,
          .channel = channel.number % kChannels};
}

// To the firing of its laser that is nearest in time, or if that has a point or its packet has
// left, to one beside it. Returns the fate that counts it.
std::uint64_t& UnitPackets::put(std::size_t turn, std::size_t point, const LaserPoint& its) {
  const long long range = numeric::round(its.range_m * 1000 / unit_->range_unit_mm);
  if (range < 1 || range > std::numeric_limits<std::uint16_t>::max()) {
    return fates_.out_of_range;
  }
  struct Choice {
    double off_us;
    const Channel* channel;
    std::int64_t firing;
  };
  std::vector<Choice> choices;
  for (const Channel& channel : channels_[its.layer]) {
    const double at_us = seen_at_us(turn, its.right - channel.right) - begin_us_ - channel.fires_us;
    const std::int64_t nearest = numeric::round(at_us / block_us_);
    for (std::int64_t firing = nearest - 1; firing <= nearest + 1; ++firing) {
      choices.push_back(
          {std::abs(at_us - static_cast<double>(firing) * block_us_), &channel, firing});
    }
  }
  std::ranges::sort(choices, {}, &Choice::off_us);
  for (const Choice& choice : choices) {
    const Slot slot = slot_of(*choice.channel, choice.firing);
    if (slot.packet < first_open_) {
      continue;
    }
    std::uint16_t& free = packet(slot.packet)[slot.block].ranges[slot.channel];
    if (free == 0) {
      free = static_cast<std::uint16_t>(range);
      if (on_sent_) {
        on_sent_({.turn = turn,
                  .point = point,
                  .datagram_us = sent_at_us(slot.packet),
                  .range = slot.block * kChannels + slot.channel});
      }
      return fates_.sent;
    }
  }
  return fates_.taken;
}

std::vector<CapturedDatagram> UnitPackets::add(std::size_t turn, const PointCloud& cloud,
                                               const PlaceAt& place_at) {
  const auto middle = static_cast<double>(turn);
  for (std::int64_t i = std::max(packet_at(middle - 0.5), first_open_);
       i <= packet_at(middle + 0.5); ++i) {
    packet(i);
  }
  fates_.not_finite += cloud.not_finite;
  for (std::size_t point = 0; point < cloud.points.size(); ++point) {
    const std::optional<LaserPoint> its = seen(turn, cloud.points[point], place_at);
    sure_ += its && its->is_sure ? 1U : 0U;
    ++(its ? put(turn, point, *its) : fates_.no_laser);
  }
  return take_before(packet_at(middle + 0.5 - kSeamTurns));
}

std::vector<CapturedDatagram> UnitPackets::finish() {
  return take_before(std::numeric_limits<std::int64_t>::max());
}

// After the head's first time.
double UnitPackets::begin_us_of(std::int64_t packet) const {
  return begin_us_ + static_cast<double>(packet * firings_) * block_us_;
}

// A packet leaves when its last firing is over.
std::uint64_t UnitPackets::sent_at_us(std::int64_t packet) const {
  return unix_us(begin_us_of(packet + 1));
}

std::uint64_t UnitPackets::unix_us(double us) const {
  return head_->first().time_us + static_cast<std::uint64_t>(numeric::round(us));
}

std::vector<CapturedDatagram> UnitPackets::take_before(std::int64_t end) {
  const std::uint32_t source = sensor_->source_ipv4 != 0 ? sensor_->source_ipv4 : kUnnamedIpv4;
  std::vector<CapturedDatagram> taken;
  for (auto it = packets_.begin(); it != packets_.end() && it->first < end;
       it = packets_.erase(it)) {
    taken.push_back(
        {.time_us = sent_at_us(it->first),
         .source = {source, sensor_->udp_port},
         .destination = {kTargetIpv4, sensor_->udp_port},
         .payload = data_packet(*unit_, it->second, unix_us(begin_us_of(it->first)), left_++)});
  }
  first_open_ = std::max(first_open_, end);
  return taken;
}

}  // namespace iog::tools
