#include "tools/info/capture_census.hpp"

#include <algorithm>
#include <iomanip>
#include <sstream>
#include <utility>

#include "intake/packet.hpp"
#include "lidar/ibeo_lux.hpp"
#include "lidar/velodyne.hpp"
#include "pose/message.hpp"
#include "tools/formats/lidar/format_names.hpp"
#include "tools/info/stream_census.hpp"

namespace iog::tools {
namespace {

std::string format_of(const PortCensus& port) {
  std::map<std::string, std::uint64_t> kinds = port.kinds;
  if (port.in_doubt > 0) {
    kinds[names_of(port.doubted)] = port.in_doubt;
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
  if (port.scans < 2 || port.last_us == port.first_us) {
    return "-";
  }
  const double seconds = static_cast<double>(port.last_us - port.first_us) / 1e6;
  std::ostringstream text;
  text << std::fixed << std::setprecision(1) << static_cast<double>(port.scans - 1) / seconds
       << " Hz";
  return text.str();
}

std::string sources_of(const PortCensus& port) {
  std::string text;
  for (const std::uint32_t source : port.sources) {
    text += (text.empty() ? "" : ", ") + dotted(source);
  }
  return text;
}

}  // namespace

std::string dotted(std::uint32_t ipv4) {
  std::string text;
  for (int shift = 24; shift >= 0; shift -= 8) {
    text += std::to_string(ipv4 >> shift & 0xFF) + (shift > 0 ? "." : "");
  }
  return text;
}

void CaptureCensus::add(const CapturedDatagram& datagram) {
  PortCensus& port = ports_[datagram.destination.port];
  if (port.datagrams++ == 0) {
    port.first_us = datagram.time_us;
  }
  port.last_us = std::max(port.last_us, datagram.time_us);
  port.bytes += datagram.payload.size();
  port.sources.insert(datagram.source.ipv4);
  lidar::IbeoLux lux;
  if (lux.decode(datagram.payload) == lidar::DecodeStatus::kOk) {
    add_numbered(std::string(lidar::IbeoLux::kName), lux.info(), port);
  } else if (pose::decode(datagram.payload).fate == pose::Fate::kUsed) {
    ++port.kinds["poses"];
  } else if (StreamCensus::is_message(datagram.payload)) {
    ++port.kinds["grid stream"];
  } else if (const auto guessed = guess_unit(datagram.payload)) {
    add_guessed(*guessed, port);
  } else {
    add_velodyne(datagram, port);
  }
}

void CaptureCensus::add_numbered(const std::string& kind, const lidar::PacketInfo& info,
                                 PortCensus& port) {
  std::uint64_t& count = port.kinds[kind];
  port.scans += count == 0 || info.scan_number != port.last_scan_number ? 1U : 0U;
  port.last_scan_number = info.scan_number;
  port.points += info.point_count;
  ++count;
}

void CaptureCensus::add_swept(const lidar::PacketInfo& info, std::uint32_t ticks_per_turn,
                              PortCensus& port) {
  port.swept_ticks += info.sector.width_ticks;
  port.scans = port.swept_ticks / ticks_per_turn;
  port.points += info.point_count;
}

void CaptureCensus::add_guessed(const GuessedPacket& guessed, PortCensus& port) {
  if (guessed.is_numbered) {
    add_numbered(guessed.name, guessed.info, port);
  } else {
    add_swept(guessed.info, guessed.ticks_per_turn, port);
    ++port.kinds[guessed.name];
  }
}

// Which unit it is often shows with the second packet only; the first is of it, too.
void CaptureCensus::add_velodyne(const CapturedDatagram& datagram, PortCensus& port) {
  const lidar::FormatSet possible = port.identities[datagram.source.ipv4].take(datagram.payload);
  if (possible.is_empty()) {
    return;
  }
  const intake::Packet packet = intake::Packet::decode(possible.first(), datagram.payload);
  if (!packet.is_sound()) {
    return;
  }
  add_swept(packet.info(), lidar::VelodynePacket::kTicksPerTurn, port);
  if (possible == lidar::FormatSet(possible.first())) {
    port.kinds[names_of(possible)] += 1 + std::exchange(port.in_doubt, 0U);
  } else {
    ++port.in_doubt;
    port.doubted = possible;
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
    line(number, format_of(port) + " ", port.datagrams, port.bytes, port.points, port.scans,
         rate_of(port));
    text << sources_of(port) << '\n';
  }
  return text.str();
}

}  // namespace iog::tools
