#include "tools/formats/lux/lux_scan.hpp"

#include <algorithm>

#include "lidar/ibeo_lux.hpp"
#include "require/require.hpp"
#include "tools/program/exit_status.hpp"
#include "wire/byte_reader.hpp"
#include "wire/byte_writer.hpp"

namespace iog::tools {
namespace {

using lidar::IbeoLux;

// The part of a scan that one message carries.
struct Part {
  std::span<const LuxPoint> points;
  std::int16_t start_ticks;
  std::int16_t end_ticks;
};

void write_point(const LuxPoint& point, wire::ByteWriter& out) {
  out.u8(static_cast<std::uint8_t>(point.layer | point.echo << 4));
  out.u8(point.flags);
  out.i16_le(point.angle_ticks);
  out.u16_le(point.range_cm);
  out.u16_le(point.pulse_width_cm);
  out.u16_le(point.reserved);
}

std::vector<std::byte> write_message(const LuxScan& scan, const Part& part) {
  const std::size_t body = IbeoLux::kScanBytes + IbeoLux::kPointBytes * part.points.size();
  std::vector<std::byte> message(IbeoLux::kHeaderBytes + body);
  wire::ByteWriter out(message);
  out.u32_be(IbeoLux::kMagic);
  out.u32_be(0);  // size of the previous message: 0 in live data
  out.u32_be(static_cast<std::uint32_t>(body));
  out.u8(0);
  out.u8(scan.device_id);
  out.u16_be(IbeoLux::kDataType);
  out.u64_be(scan.sent_ntp);
  out.u16_le(scan.scan_number);
  out.u16_le(scan.status);
  out.u16_le(scan.sync_phase);
  out.u64_le(scan.start_ntp);
  out.u64_le(scan.end_ntp);
  out.u16_le(scan.ticks_per_turn);
  out.i16_le(part.start_ticks);
  out.i16_le(part.end_ticks);
  out.u16_le(static_cast<std::uint16_t>(part.points.size()));
  for (const std::int16_t value : scan.mounting) {
    out.i16_le(value);
  }
  out.u16_le(scan.flags);
  for (const LuxPoint& point : part.points) {
    write_point(point, out);
  }
  require(out.ok() && out.remaining() == 0);
  return message;
}

LuxPoint read_point(wire::ByteReader& in) {
  LuxPoint point;
  const std::uint8_t layer_and_echo = in.u8();
  point.layer = layer_and_echo & 0x0F;
  point.echo = layer_and_echo >> 4;
  point.flags = in.u8();
  point.angle_ticks = in.i16_le();
  point.range_cm = in.u16_le();
  point.pulse_width_cm = in.u16_le();
  point.reserved = in.u16_le();
  return point;
}

// How many of the points, which are in order of the sweep, go into the next message.
std::size_t points_of_next(std::span<const LuxPoint> rest, std::size_t most) {
  if (rest.size() <= most) {
    return rest.size();
  }
  std::size_t count = most;
  while (count > 0 && rest[count - 1].angle_ticks == rest[count].angle_ticks) {
    --count;
  }
  return count > 0 ? count : most;
}

}  // namespace

LuxScan parse_lux_message(std::span<const std::byte> message) {
  IbeoLux decoder;
  if (decoder.decode(message) != lidar::DecodeStatus::kOk) {
    throw UsageError("a LUX message that contradicts itself");
  }
  LuxScan scan;
  wire::ByteReader in(message);
  in.skip(4 + 4 + 4 + 1);  // magic, sizes, reserved: checked above
  scan.device_id = in.u8();
  in.skip(2);
  scan.sent_ntp = in.u64_be();
  scan.scan_number = in.u16_le();
  scan.status = in.u16_le();
  scan.sync_phase = in.u16_le();
  scan.start_ntp = in.u64_le();
  scan.end_ntp = in.u64_le();
  scan.ticks_per_turn = in.u16_le();
  scan.start_ticks = in.i16_le();
  scan.end_ticks = in.i16_le();
  scan.points.resize(in.u16_le());
  for (std::int16_t& value : scan.mounting) {
    value = in.i16_le();
  }
  scan.flags = in.u16_le();
  for (LuxPoint& point : scan.points) {
    point = read_point(in);
  }
  return scan;
}

std::vector<std::vector<std::byte>> split_lux_scan(LuxScan scan, std::size_t max_bytes) {
  constexpr std::size_t kFixedBytes = IbeoLux::kHeaderBytes + IbeoLux::kScanBytes;
  require(max_bytes >= kFixedBytes + IbeoLux::kPointBytes);
  const std::size_t most = (max_bytes - kFixedBytes) / IbeoLux::kPointBytes;
  const bool sweeps_right = scan.start_ticks >= scan.end_ticks;
  std::ranges::stable_sort(scan.points, [&](const LuxPoint& a, const LuxPoint& b) {
    return sweeps_right ? a.angle_ticks > b.angle_ticks : a.angle_ticks < b.angle_ticks;
  });
  std::vector<std::vector<std::byte>> messages;
  std::span<const LuxPoint> rest = scan.points;
  std::int16_t start_ticks = scan.start_ticks;
  do {
    const std::size_t count = points_of_next(rest, most);
    const std::int16_t end_ticks =
        count < rest.size() ? rest[count - 1].angle_ticks : scan.end_ticks;
    messages.push_back(write_message(scan, {rest.first(count), start_ticks, end_ticks}));
    start_ticks = end_ticks;
    rest = rest.subspan(count);
  } while (!rest.empty());
  return messages;
}

}  // namespace iog::tools
