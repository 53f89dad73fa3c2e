#include "tools/formats/lux/lux_scan.hpp"

#include <algorithm>

#include "require/require.hpp"
#include "tools/program/exit_status.hpp"
#include "wire/byte_reader.hpp"

namespace iog::tools {
namespace {

using lidar::IbeoLux;

std::vector<std::byte> write_message(const LuxHead& head, std::span<const LuxPoint> points) {
  std::vector<std::byte> message(IbeoLux::kHeaderBytes + IbeoLux::kScanBytes +
                                 IbeoLux::kPointBytes * points.size());
  wire::ByteWriter out(message);
  write_lux_head(head, points.size(), out);
  for (const LuxPoint& point : points) {
    write_lux_point(point, out);
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
  LuxHead head = scan;
  do {
    const std::size_t count = points_of_next(rest, most);
    head.end_ticks = count < rest.size() ? rest[count - 1].angle_ticks : scan.end_ticks;
    messages.push_back(write_message(head, rest.first(count)));
    head.start_ticks = head.end_ticks;
    rest = rest.subspan(count);
  } while (!rest.empty());
  return messages;
}

}  // namespace iog::tools
