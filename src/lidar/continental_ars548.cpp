#include "lidar/continental_ars548.hpp"

#include <algorithm>
#include <optional>

#include "lidar/fingerprint.hpp"
#include "wire/binary32.hpp"
#include "wire/byte_reader.hpp"

namespace iog::lidar {
namespace {

using wire::nearest_product;

constexpr int kFactorBits = 20;
constexpr std::uint32_t kMillimetresPerMetre = 1000U << kFactorBits;
constexpr std::uint32_t kTicksPerRadian = 1'922'527'338;  // 2^20 11520 / 2 pi
constexpr std::uint32_t kDegreesPerRadian = 60'078'979;   // 2^20 180 / pi
// Elevations and the edges of the field of view are compared in units of 2^-10 degrees.
constexpr int kAngleBits = 10;
constexpr int kAngleFactorBits = kFactorBits - kAngleBits;

constexpr std::int64_t kHalfTurn = ContinentalArs548::kTicksPerTurn / 2;
constexpr std::int64_t kRightAngle = std::int64_t{90} << kAngleBits;
constexpr std::int64_t kHalfWidth = ContinentalArs548::kDataSheet.scan_width_ticks / 2;
constexpr std::int64_t kWidest =
    (kHalfWidth << kAngleBits) * 360 / ContinentalArs548::kTicksPerTurn;
constexpr std::int64_t kSteepest = std::int64_t{ContinentalArs548::kSteepestDeg} << kAngleBits;

// The fields of a detection that are used.
struct Detection {
  static constexpr std::uint8_t kNoRange = 0x01;
  static constexpr std::uint8_t kNoAzimuth = 0x04;
  static constexpr std::uint8_t kNoElevation = 0x10;
  static constexpr std::uint8_t kNoElevationSigma = 0x20;
  static constexpr std::uint8_t kNoise = 1;
  static constexpr std::uint8_t kGround = 2;
  static constexpr std::uint8_t kTraversableUnder = 3;

  explicit Detection(std::span<const std::byte, ContinentalArs548::kDetectionBytes> bytes)
      : azimuth_ticks(
            nearest_product(wire::load_be32(bytes.subspan<0, 4>()), kTicksPerRadian, kFactorBits)),
        azimuth(nearest_product(wire::load_be32(bytes.subspan<0, 4>()), kDegreesPerRadian,
                                kAngleFactorBits)),
        elevation(nearest_product(wire::load_be32(bytes.subspan<9, 4>()), kDegreesPerRadian,
                                  kAngleFactorBits)),
        elevation_sigma(nearest_product(wire::load_be32(bytes.subspan<13, 4>()), kDegreesPerRadian,
                                        kAngleFactorBits)),
        range_mm(nearest_product(wire::load_be32(bytes.subspan<17, 4>()), kMillimetresPerMetre,
                                 kFactorBits)),
        invalid(wire::load_u8(bytes.subspan<8, 1>())),
        existence(wire::load_u8(bytes.subspan<36, 1>())),
        what(wire::load_u8(bytes.subspan<37, 1>())) {}

  [[nodiscard]] bool is_valid() const {
    return (invalid & (kNoRange | kNoAzimuth | kNoElevation)) == 0;
  }
  [[nodiscard]] bool has_sigma() const { return (invalid & kNoElevationSigma) == 0; }
  // The elevation, moved towards the horizon by its standard deviation, at most to the horizon.
  // Only if is_place().
  [[nodiscard]] std::int64_t nearest_elevation() const {
    const std::int64_t sigma = has_sigma() ? *elevation_sigma : 0;
    return *elevation > 0 ? std::max<std::int64_t>(*elevation - sigma, 0)
                          : std::min<std::int64_t>(*elevation + sigma, 0);
  }

  std::optional<std::int64_t> azimuth_ticks;
  std::optional<std::int64_t> azimuth;
  std::optional<std::int64_t> elevation;
  std::optional<std::int64_t> elevation_sigma;
  std::optional<std::int64_t> range_mm;
  std::uint8_t invalid;
  std::uint8_t existence;
  std::uint8_t what;
};

bool is_within(const std::optional<std::int64_t>& value, std::int64_t least, std::int64_t most) {
  return value && *value >= least && *value <= most;
}

}  // namespace

// A valid detection must have a possible position and a probability.
bool ContinentalArs548::is_place(DetectionBytes bytes) {
  const Detection detection(bytes);
  return !detection.is_valid() ||
         (is_within(detection.azimuth_ticks, -kHalfTurn, kHalfTurn) &&
          is_within(detection.elevation, -kRightAngle, kRightAngle) &&
          (!detection.has_sigma() || is_within(detection.elevation_sigma, 0, kRightAngle)) &&
          is_within(detection.range_mm, 0, kMaxRangeMm) && detection.existence <= 100);
}

ScanPoint ContinentalArs548::point(DetectionBytes bytes) {
  const Detection detection(bytes);
  if (!detection.is_valid()) {
    return {.layer = kSteepestDeg, .is_rain = true};
  }
  const std::int64_t azimuth = *detection.azimuth_ticks;
  const std::int64_t elevation = detection.nearest_elevation();
  // Compared before rounding: 30.4 degrees are beyond 30, but would round to the layer of 30.
  const bool is_seen = is_within(detection.azimuth, -kWidest, kWidest) &&
                       is_within(elevation, -kSteepest, kSteepest);
  const std::int64_t elevation_deg = (elevation + (1 << (kAngleBits - 1))) >> kAngleBits;
  const bool is_target = is_seen && detection.existence >= kLeastExistence &&
                         detection.what != Detection::kNoise &&
                         detection.what != Detection::kTraversableUnder;
  return {
      .range_mm = static_cast<std::uint32_t>(*detection.range_mm),
      .azimuth_ticks = static_cast<std::uint16_t>((azimuth + kTicksPerTurn) % kTicksPerTurn),
      .layer = static_cast<std::uint8_t>(
          std::clamp<std::int64_t>(elevation_deg, -kSteepestDeg, kSteepestDeg) + kSteepestDeg),
      .is_ground = detection.what == Detection::kGround,
      .is_rain = !is_target,
  };
}

DecodeStatus ContinentalArs548::decode(std::span<const std::byte> datagram) {
  *this = ContinentalArs548{};
  wire::ByteReader head(datagram);
  const std::uint16_t service = head.u16_be();
  const std::uint16_t method = head.u16_be();
  const std::uint32_t length = head.u32_be();
  if (head.ok() && (service != 0 || method != kMethod)) {
    return DecodeStatus::kWrongType;
  }
  if (datagram.size() != kBytes || length != kBytes - 8) {
    return DecodeStatus::kWrongLength;
  }
  head.skip(8 + 20);  // the rest of a SOME/IP header, and an E2E header that is not in use
  const auto stamp = datagram.subspan(36, 9);
  const std::uint32_t nanoseconds = head.u32_be();
  const std::uint32_t seconds = head.u32_be();

  wire::ByteReader tail(datagram.last(kTailBytes));
  tail.skip(8);  // the unambiguous speeds
  const std::uint32_t count = tail.u32_be();
  if (count > kMostDetections) {
    return DecodeStatus::kWrongPoint;
  }
  detections_ = datagram.subspan(kHeadBytes, count * kDetectionBytes);
  info_.point_count = count;

  constexpr std::uint64_t kSecondUs = 1'000'000;
  constexpr std::uint64_t kNumberUs = 32'768;  // shorter than the shortest cycle, 50 ms
  const std::uint64_t time_us = seconds * kSecondUs + nanoseconds / 1000;
  info_.scan_number = static_cast<std::uint32_t>(time_us / kNumberUs);
  info_.sweep = {.begin_us = time_us, .end_us = time_us, .is_of_packet = true};
  info_.sector = {.first_ticks = static_cast<std::uint16_t>(kTicksPerTurn - kHalfWidth),
                  .width_ticks = static_cast<std::uint16_t>(2 * kHalfWidth)};
  info_.fingerprint = fingerprint(stamp);
  if (!detections_.empty()) {
    info_.fingerprint = fingerprint(detections_.first<kDetectionBytes>(), info_.fingerprint);
    info_.fingerprint = fingerprint(detections_.last<kDetectionBytes>(), info_.fingerprint);
  }
  for (auto rest = detections_; !rest.empty(); rest = rest.subspan(kDetectionBytes)) {
    if (!is_place(rest.first<kDetectionBytes>())) {
      return DecodeStatus::kWrongPoint;
    }
  }
  return DecodeStatus::kOk;
}

}  // namespace iog::lidar
