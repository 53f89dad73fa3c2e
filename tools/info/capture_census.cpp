#include "tools/info/capture_census.hpp"

#include <algorithm>
#include <cmath>
#include <iomanip>
#include <sstream>
#include <utility>

#include "pose/message.hpp"
#include "tools/program/fixed.hpp"
#include "tools/receive/stream_census.hpp"
#include "tools/vehicles/named_senders.hpp"
#include "tools/vehicles/network_words.hpp"

namespace iog::tools {
namespace {

std::string format_of(const PortCensus& port) {
  std::map<std::string, std::uint64_t> kinds = port.kinds;
  if (port.in_doubt > 0) {
    kinds[port.doubted] = port.in_doubt;
  }
  std::string text;
  for (const auto& [name, count] : kinds) {
    if (count == port.datagrams) {
      return name;
    }
    text += (text.empty() ? "" : ", ") + std::to_string(count) + " " + name;
  }
  return text.empty() ? "other" : text;
}

std::string rate_of(const PortCensus& port) {
  double hertz = 0;
  for (const auto& [source, sender] : port.senders) {
    hertz += sender.hertz();
  }
  return hertz == 0 ? "-" : fixed(hertz, 1) + " Hz";
}

std::string sources_of(const PortCensus& port) {
  std::string text;
  for (const auto& [source, sender] : port.senders) {
    text += (text.empty() ? "" : ", ") + dotted(source);
  }
  return text + (port.has_others ? ", others" : "");
}

}  // namespace

void SenderCensus::add(const SeenUnit& seen, std::uint64_t time_us) {
  const bool is_first = scans == 0 && swept_ticks == 0;
  const lidar::PacketInfo& info = seen.info;
  if (is_first) {
    first_us = time_us;
  }
  if (seen.turns) {
    // The wire's sweeps are clockwise, and end where, counter-clockwise, their sector begins.
    const std::uint32_t turn = seen.ticks_per_turn;
    const std::uint32_t gained = is_first ? 0 : (at_ticks + turn - info.sector.first_ticks) % turn;
    const bool is_late = gained > turn / 8 * 7;  // it was overtaken
    gained_ticks += is_late ? 0 : gained;
    at_ticks = is_late ? at_ticks : info.sector.first_ticks;
    last_us = std::max(last_us, is_late ? 0 : time_us);
    swept_ticks += info.sector.width_ticks;
    ticks_per_turn = turn;
  }
  if (seen.is_numbered && (is_first || info.scan_number != last_scan_number)) {
    ++scans;
    last_us = std::max(last_us, time_us);
  } else if (!seen.is_numbered) {
    scans = swept_ticks / seen.ticks_per_turn;
  }
  last_scan_number = info.scan_number;
}

double SenderCensus::hertz() const {
  if (last_us <= first_us) {
    return 0;
  }
  const double seconds = static_cast<double>(last_us - first_us) / 1e6;
  if (ticks_per_turn == 0) {
    return scans < 2 ? 0 : static_cast<double>(scans - 1) / seconds;
  }
  // Of less than a quarter of a turn the times of arrival say little.
  return gained_ticks < ticks_per_turn / 4
             ? 0
             : static_cast<double>(gained_ticks) / ticks_per_turn / seconds;
}

int SenderCensus::missing_percent() const {
  constexpr int kNoise = 3;
  if (ticks_per_turn == 0 || gained_ticks < ticks_per_turn) {
    return 0;
  }
  const auto seen = static_cast<double>(swept_ticks) / static_cast<double>(gained_ticks);
  const auto percent = static_cast<int>(std::lround(100 * (1 - seen)));
  return percent < kNoise ? 0 : percent;
}

std::uint64_t PortCensus::scans() const {
  std::uint64_t all = 0;
  for (const auto& [source, sender] : senders) {
    all += sender.scans;
  }
  return all;
}

void CaptureCensus::add(const CapturedDatagram& datagram) {
  PortCensus& port = ports_[datagram.destination.port];
  ++port.datagrams;
  port.bytes += datagram.payload.size();
  if (port.senders.size() >= kMostSenders && !port.senders.contains(datagram.source.ipv4)) {
    port.has_others = true;
    return;
  }
  if (pose::decode(datagram.payload).fate == pose::Fate::kUsed) {
    ++port.kinds["poses"];
  } else if (StreamCensus::is_message(datagram.payload)) {
    ++port.kinds["grid stream"];
  } else {
    add_unit(datagram, port);
    return;
  }
  port.senders.try_emplace(datagram.source.ipv4);
}

// Which unit it is often shows with the second packet only; the first is of it, too.
void CaptureCensus::add_unit(const CapturedDatagram& datagram, PortCensus& port) {
  SenderCensus& sender = port.senders[datagram.source.ipv4];
  const SeenUnit seen = sender.unit.take(datagram.payload);
  if (seen.name.empty() || (!seen.is_sound && !seen.formats.is_empty())) {
    return;
  }
  if (seen.is_sound) {
    sender.add(seen, datagram.time_us);
    sender.pace.add(seen.info.sweep.begin_us, datagram.time_us);
    port.points += seen.info.point_count;
  }
  if (seen.is_in_doubt) {
    ++port.in_doubt;
    port.doubted = seen.name;
  } else {
    port.kinds[seen.name] += 1 + std::exchange(port.in_doubt, 0U);
  }
}

std::string CaptureCensus::table() const {
  std::ostringstream text;
  const auto line = [&](const auto& port, const auto& format, const auto&... cells) {
    constexpr int kWidth = 12;
    text << std::left << std::setw(kWidth) << port << std::setw(2 * kWidth) << format;
    ((text << std::setw(kWidth) << cells), ...);
  };
  line("port", "format", "packets", "bytes", "points", "scans", "rate");
  text << "from\n";
  for (const auto& [number, port] : ports_) {
    line(number, format_of(port) + " ", port.datagrams, port.bytes, port.points, port.scans(),
         rate_of(port));
    text << sources_of(port) << '\n';
  }
  for (const auto& [number, port] : ports_) {
    for (const auto& [source, sender] : port.senders) {
      const std::string words = sender.pace.words(dotted(source));
      text << words << (words.empty() ? "" : "\n");
      if (const int missing = sender.missing_percent(); missing > 0) {
        text << dotted(source) << ": about " << missing
             << " % of the directions are missing: packets were lost, or the unit is set to a "
                "narrower field of view\n";
      }
    }
  }
  return text.str();
}

}  // namespace iog::tools
