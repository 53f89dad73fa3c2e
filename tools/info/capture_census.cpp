#include "tools/info/capture_census.hpp"

#include <algorithm>
#include <iomanip>
#include <sstream>

#include "lidar/ibeo_lux.hpp"
#include "lidar/velodyne_vlp16.hpp"

namespace iog::tools {
namespace {

std::string format_of(const PortCensus& port) {
  if (port.lux == port.datagrams) {
    return "ibeo LUX";
  }
  if (port.vlp16 == port.datagrams) {
    return "VLP-16";
  }
  if (port.lux + port.vlp16 == 0) {
    return "other";
  }
  return std::to_string(port.lux) + " LUX, " + std::to_string(port.vlp16) + " VLP-16";
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
  lidar::VelodyneVlp16 vlp16;
  if (lux.decode(datagram.payload) == lidar::DecodeStatus::kOk) {
    const bool is_next = port.lux == 0 || lux.info().scan_number != port.last_scan_number;
    port.scans += is_next ? 1U : 0U;
    port.last_scan_number = lux.info().scan_number;
    port.points += lux.info().point_count;
    ++port.lux;
  } else if (vlp16.decode(datagram.payload) == lidar::DecodeStatus::kOk) {
    port.swept_ticks += vlp16.info().sector.width_ticks;
    port.scans = port.swept_ticks / lidar::VelodyneVlp16::kTicksPerTurn;
    port.points += vlp16.info().point_count;
    ++port.vlp16;
  }
}

std::string CaptureCensus::table() const {
  std::ostringstream text;
  const auto line = [&](const auto&... cells) {
    constexpr int kWidth = 12;
    ((text << std::left << std::setw(kWidth) << cells), ...);
  };
  line("port", "format", "packets", "bytes", "points", "scans", "rate");
  text << "from\n";
  for (const auto& [number, port] : ports_) {
    line(number, format_of(port), port.datagrams, port.bytes, port.points, port.scans,
         rate_of(port));
    text << sources_of(port) << '\n';
  }
  return text.str();
}

}  // namespace iog::tools
