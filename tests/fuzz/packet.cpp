// Every decoder of the one list on two packets of its format, one after the other. The input's
// first byte chooses the format, the second the unit, and two pieces are the packets' bytes, made
// such that length, head and checksum do not hide what follows.
#include "intake/packet.hpp"

#include <algorithm>
#include <array>
#include <type_traits>
#include <vector>

#include "fakes/any_packet.hpp"
#include "law.hpp"
#include "lidar/velodyne_identity.hpp"
#include "tools/formats/lux/lux_scan.hpp"
#include "tools/program/exit_status.hpp"

namespace iog::fuzz {
namespace {

using Bytes = std::vector<std::byte>;
using lidar::DecodeStatus;

template <typename Decoder>
constexpr bool kIsOuster = std::is_base_of_v<lidar::OusterPacket, Decoder>;
template <typename Decoder>
constexpr bool kIsVelodyne = std::is_base_of_v<lidar::VelodynePacket, Decoder>;

// What is not said in packets: an Ouster has few rows, or so many that its packets may be
// another's; the others have corrections, or none.
template <typename Decoder>
lidar::Unit unit_of(std::uint8_t mode) {
  static const auto corrections = [] {
    constexpr std::array<lidar::LaserCorrection, 8> kEight{{{397, 0},
                                                            {-23'040, -30'000},
                                                            {23'040, 30'000},
                                                            {-1, 1},
                                                            {-3'000, 10'000},
                                                            {32'767, -30'000},
                                                            {-32'768, 1},
                                                            {-521, 30'000}}};
    std::array<lidar::LaserCorrection, 128> all{};
    for (std::size_t i = 0; i < all.size(); ++i) {
      all.at(i) = kEight.at(i % kEight.size());
    }
    return all;
  }();
  if constexpr (lidar::IsPoints<Decoder>) {
    static constexpr std::array<std::int32_t, 6> kElevations{-284'800, -3'200, -3'199,
                                                             0,        70'000, 284'800};
    return {.elevations = std::span(kElevations).first(1 + mode % kElevations.size())};
  }
  const bool is_high = mode >= 128;
  std::size_t count = is_high ? 64 : 4;
  if constexpr (!kIsOuster<Decoder>) {
    count = is_high ? 0 : lidar::layers_of<Decoder>();
  }
  return {.corrections = std::span(corrections).first(count),
          .columns_per_turn = static_cast<std::uint16_t>(512U << (mode % 3U)),
          .column_ns = 195'312U >> (mode / 3U % 4U)};
}

// As many bytes as a packet of the unit has, or as were given where that is up to a packet.
template <typename Decoder>
Bytes packet_of(std::span<const std::byte> given, const lidar::Unit& unit, std::uint8_t mode) {
  Bytes bytes(given.begin(), given.end());
  if constexpr (lidar::IsRadar<Decoder>) {
    constexpr std::size_t kFirst = 36;  // behind a head that is right
    const std::size_t count = std::min(std::size_t{4} * mode, Decoder::kMostDetections);
    bytes = tests::Ars548List{.detections = std::vector<tests::Ars548Detection>(count)}.bytes();
    std::ranges::copy(given.first(std::min(given.size(), bytes.size() - kFirst)),
                      bytes.begin() + kFirst);
  } else if constexpr (lidar::IsUltrasonic<Decoder>) {
    if (mode % 2 == 0 && bytes.size() > 2) {
      const std::size_t end = bytes.size() - 2;
      const auto sum = tests::mavlink_checksum(std::span(bytes).first(end), 85);
      bytes[end] = static_cast<std::byte>(sum & 0xFFU);
      bytes[end + 1] = static_cast<std::byte>(sum >> 8);
    }
  } else if constexpr (lidar::IsPoints<Decoder>) {
    bytes.resize(std::max(bytes.size(), Decoder::kHeadBytes));
    const auto points = std::to_integer<std::size_t>(bytes[6]);
    bytes.resize(Decoder::kHeadBytes + points * Decoder::kPointBytes);
  } else if constexpr (kIsOuster<Decoder>) {
    bytes.resize(Decoder::packet_bytes(unit.corrections.size()));
  } else if constexpr (kIsVelodyne<Decoder>) {
    bytes.resize(Decoder::kPacketBytes);
  } else if constexpr (Decoder::kTurns) {
    bytes.resize(Decoder::unit().bytes + mode % 2U * Decoder::unit().may_follow_bytes);
  }
  return bytes;
}

bool same(const lidar::ScanPoint& a, const lidar::ScanPoint& b) {
  return a.range_mm == b.range_mm && a.azimuth_ticks == b.azimuth_ticks && a.layer == b.layer &&
         a.echo == b.echo && a.is_ground == b.is_ground && a.is_dirt == b.is_dirt &&
         a.is_rain == b.is_rain;
}

template <typename Decoder>
std::vector<lidar::ScanPoint> points_of(const Decoder& decoder) {
  std::vector<lidar::ScanPoint> points;
  decoder.for_each_point([&](const lidar::ScanPoint& point) { points.push_back(point); });
  return points;
}

bool tools_accept(std::span<const std::byte> message) {
  try {
    static_cast<void>(tools::parse_lux_message(message));
    return true;
  } catch (const tools::UsageError&) {
    return false;
  }
}

// A LUX 8L sends each direction's points as a LUX does, of the mirror's upper or lower side.
void check_side(std::span<const std::byte> packet, const std::vector<lidar::ScanPoint>& points) {
  lidar::IbeoLux four;
  law(four.decode(packet) == DecodeStatus::kOk, "it is a message of a LUX, too");
  std::size_t number = 0;
  four.for_each_point([&](const lidar::ScanPoint& point) {
    const lidar::ScanPoint& its = points[number++];
    law(its.layer % 4 == point.layer && its.layer / 4 == points[0].layer / 4,
        "all points are of one side of the mirror");
    law(its.azimuth_ticks <= lidar::IbeoLux8::kLeftmostTicks ||
            its.azimuth_ticks >= lidar::IbeoLux8::kTicksPerTurn + lidar::IbeoLux8::kRightmostTicks,
        "an azimuth is within the field of view");
  });
}

// What is promised of one format alone.
template <typename Decoder>
void check_of_format(std::span<const std::byte> packet, bool is_sound,
                     const std::vector<lidar::ScanPoint>& points) {
  if constexpr (std::is_same_v<Decoder, lidar::IbeoLux>) {
    law(tools_accept(packet) == is_sound, "the PC reads what the target reads");
  } else if constexpr (std::is_same_v<Decoder, lidar::IbeoLux8>) {
    if (is_sound) {
      check_side(packet, points);
    }
  } else if constexpr (kIsVelodyne<Decoder>) {
    law(!is_sound || points.size() == Decoder::kPointsPerPacket, "384 points");
  } else if constexpr (lidar::IsUltrasonic<Decoder>) {
    law(!is_sound || (points.size() == 1 && points[0].azimuth_ticks == 0), "a point on the axis");
  } else if constexpr (kIsOuster<Decoder>) {
    law(!is_sound || !points.empty(), "a packet without columns is none");
  }
}

void check_identity(std::span<const std::byte> before, std::span<const std::byte> packet) {
  lidar::VelodyneIdentity identity;
  for (const auto& bytes : {before, packet, before, packet}) {
    const lidar::FormatSet possible = identity.add(bytes);
    lidar::for_each_format(
        [&]<typename Other>(lidar::Format format, std::type_identity<Other> /*which*/) {
          law(kIsVelodyne<Other> || !possible.has(format), "no other maker's format is possible");
        });
  }
}

template <typename Decoder>
void check(std::uint8_t mode, std::span<const std::byte> first, std::span<const std::byte> second) {
  const lidar::Unit unit = unit_of<Decoder>(mode);
  const Bytes before = packet_of<Decoder>(first, unit, mode);
  const Bytes packet = packet_of<Decoder>(second, unit, mode);
  Decoder used;
  static_cast<void>(intake::decode_with(used, before, unit));
  Decoder fresh;
  const DecodeStatus status = intake::decode_with(fresh, packet, unit);
  const bool is_sound = status == DecodeStatus::kOk;
  law(intake::decode_with(used, packet, unit) == status, "the packet before has no influence");
  std::vector<lidar::ScanPoint> points;
  if (is_sound) {
    const std::size_t layers = kIsOuster<Decoder>         ? unit.corrections.size()
                               : lidar::IsPoints<Decoder> ? unit.elevations.size()
                                                          : lidar::layers_of<Decoder>();
    const char* const broken = tests::broken_law(fresh, layers);
    law(broken == nullptr, broken);
    points = points_of(fresh);
    law(std::ranges::equal(points, points_of(used), same), "nor on the points");
    law(fresh.info().fingerprint == used.info().fingerprint, "nor on what tells it from others");
  }
  check_of_format<Decoder>(packet, is_sound, points);
  if constexpr (kIsVelodyne<Decoder>) {
    check_identity(before, packet);
  }
  // Of points the head is judged before the length.
  if ((Decoder::kTurns && !lidar::IsPoints<Decoder>) || is_sound) {
    const auto shorter = std::span(packet).first(packet.size() - 1);
    law(intake::decode_with(used, shorter, unit) == DecodeStatus::kWrongLength,
        "a shorter packet is refused");
  }
}

}  // namespace

void check(std::span<const std::byte> input) {
  wire::ByteReader in(input);
  const auto format = static_cast<lidar::Format>(in.u8() % lidar::kFormatCount);
  const std::uint8_t mode = in.u8();
  const auto before = next_piece(in);
  const auto packet = in.bytes(in.remaining());
  lidar::with_decoder(format, [&]<typename Decoder>(std::type_identity<Decoder> /*which*/) {
    check<Decoder>(mode, before, packet);
  });
}

}  // namespace iog::fuzz
