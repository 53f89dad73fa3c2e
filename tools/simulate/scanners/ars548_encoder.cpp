// A simulated Continental ARS548: detection lists as it would send them ten times a second
// (lidar/continental_ars548.hpp).
//
// In each degree of its field of view it reports the nearest thing on its horizon. What a real unit
// reports besides is not simulated: ghosts, and what it sees past other things.
#include <algorithm>
#include <bit>

#include "lidar/continental_ars548.hpp"
#include "numeric/elementary.hpp"
#include "require/require.hpp"
#include "tools/car/description.hpp"
#include "tools/car/mount.hpp"
#include "tools/formats/capture/made_capture.hpp"
#include "tools/simulate/scanners/encoders.hpp"
#include "tools/simulate/scanners/spinning_beams.hpp"
#include "wire/byte_writer.hpp"

namespace iog::tools {
namespace {

using lidar::ContinentalArs548;

constexpr std::uint64_t kCycleNs = 1'000'000'000 / kTurnsPerSecond;
constexpr int kSideDeg = 60;
constexpr double kElevationSigmaDeg = 1;

void write(float value, wire::ByteWriter& out) { out.u32_be(std::bit_cast<std::uint32_t>(value)); }
void write_degrees(double degrees, wire::ByteWriter& out) {
  write(static_cast<float>(description::radians(degrees)), out);
}

void write_head(std::uint64_t stamp_us, wire::ByteWriter& out) {
  constexpr std::uint64_t kSecondUs = 1'000'000;
  out.u16_be(0);
  out.u16_be(ContinentalArs548::kMethod);
  out.u32_be(ContinentalArs548::kBytes - 8);
  out.u32_be(0);
  out.u32_be(0x01010200);  // versions, a notification, no error
  out.zeros(20);
  out.u32_be(static_cast<std::uint32_t>(stamp_us % kSecondUs * 1000));
  out.u32_be(static_cast<std::uint32_t>(stamp_us / kSecondUs));
  out.u8(1);  // synchronised
  out.zeros(ContinentalArs548::kHeadBytes - out.written().size());
}

struct Detection {
  double azimuth_deg = 0;
  double elevation_deg = 0;
  double range_m = 0;
  double azimuth_sigma_deg = 0;
  double range_sigma_m = 0;
};

void write(const Detection& detection, std::uint16_t number, wire::ByteWriter& out) {
  constexpr std::uint8_t kSure = 100;
  constexpr std::uint8_t kObstacle = 4;
  write_degrees(detection.azimuth_deg, out);
  write_degrees(detection.azimuth_sigma_deg, out);
  out.u8(0);  // nothing is invalid
  write_degrees(detection.elevation_deg, out);
  write_degrees(kElevationSigmaDeg, out);
  write(static_cast<float>(detection.range_m), out);
  write(static_cast<float>(detection.range_sigma_m), out);
  out.zeros(4 + 4 + 1);  // speed and its deviation, cross-section
  out.u16_be(number);
  out.u8(kSure);
  out.u8(kObstacle);
  out.zeros(1 + 2 + 1 + 2);  // of several targets, object, ambiguity, order
}

class Ars548Encoder final : public PacketEncoder {
 public:
  explicit Ars548Encoder(const description::SensorConfig& config) : config_(config) {}

  [[nodiscard]] std::uint64_t packet_ns() const override { return kCycleNs; }

  // All of a list is measured when its cycle is over.
  [[nodiscard]] std::vector<std::byte> packet(std::uint64_t begin_ns, std::uint64_t /*number*/,
                                              const RayCaster& rays, Random& random,
                                              std::vector<PointTruth>& truth) const override {
    std::vector<std::byte> bytes(ContinentalArs548::kBytes);
    wire::ByteWriter out(bytes);
    const std::uint64_t end_ns = begin_ns + kCycleNs;
    write_head(kDriveStartUs + end_ns / 1000, out);
    const double time_s = static_cast<double>(end_ns) / 1e9;
    const SensorFrame frame = rays.frame_at(time_s);
    std::uint16_t count = 0;
    for (int degree = -kSideDeg; degree <= kSideDeg; ++degree) {
      const double azimuth = description::radians(degree);
      const Ray ray{frame.origin,
                    frame.direction({numeric::cos(azimuth), numeric::sin(azimuth), 0})};
      const Hit hit = rays.nearest(ray, time_s);
      if (hit.material == Material::kGround || hit.distance > kSpinningFarthest) {
        continue;
      }
      truth.push_back(rays.truth_of(ray, hit));
      write({.azimuth_deg = degree + config_.azimuth_sigma_deg * random.bell(),
             .elevation_deg = kElevationSigmaDeg * random.bell(),
             .range_m = std::max(0.1, hit.distance + config_.sigma_m * random.bell()),
             .azimuth_sigma_deg = config_.azimuth_sigma_deg,
             .range_sigma_m = config_.sigma_m},
            count++, out);
    }
    out.zeros((ContinentalArs548::kMostDetections - count) * ContinentalArs548::kDetectionBytes +
              8);
    out.u32_be(count);
    out.zeros(out.remaining());
    require(out.ok());
    return bytes;
  }

 private:
  description::SensorConfig config_;
};

}  // namespace

std::unique_ptr<PacketEncoder> ars548_encoder(const description::SensorConfig& config) {
  return std::make_unique<Ars548Encoder>(config);
}

}  // namespace iog::tools
