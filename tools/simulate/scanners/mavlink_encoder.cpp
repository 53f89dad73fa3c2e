// A simulated ultrasonic unit behind MAVLink 2: what it hears first, ten times a second
// (lidar/mavlink_ultrasonic.hpp).
//
// In each degree of its cone it looks at the nearest thing on its horizon, and hears all that it
// meets. What a real unit is deaf to, echoes of echoes and other units' sounds are not simulated.
#include <algorithm>
#include <span>

#include "lidar/mavlink_ultrasonic.hpp"
#include "numeric/elementary.hpp"
#include "require/require.hpp"
#include "tools/car/description.hpp"
#include "tools/car/mount.hpp"
#include "tools/simulate/scanners/encoders.hpp"
#include "wire/byte_writer.hpp"

namespace iog::tools {
namespace {

using lidar::MavlinkUltrasonic;

constexpr std::uint64_t kCycleNs = 1'000'000'000 / kTurnsPerSecond;
constexpr std::uint32_t kMessage = 132;
constexpr std::uint8_t kUltrasound = 1;
constexpr std::size_t kPayloadBytes = 14;  // what follows is 0 and not sent
constexpr std::uint8_t kVariance = 4;      // cm^2

// Of the first angular cell to either side and half of the next, as the sensor's arc.
constexpr double kSidesOfSigma = 1.5;

struct Distances {
  std::uint16_t least_cm = 0;
  std::uint16_t most_cm = 0;
  std::uint16_t heard_cm = 0;
};

std::vector<std::byte> message_of(std::uint32_t time_ms, std::uint8_t sequence,
                                  const Distances& distances) {
  std::vector<std::byte> bytes(MavlinkUltrasonic::kHeadBytes + kPayloadBytes +
                               MavlinkUltrasonic::kChecksumBytes);
  wire::ByteWriter out(bytes);
  out.u8(0xFD);
  out.u8(kPayloadBytes);
  out.zeros(2);
  out.u8(sequence);
  out.u8(1);  // the sender
  out.u8(1);
  out.u8(kMessage);
  out.u16_le(0);
  out.u32_le(time_ms);
  out.u16_le(distances.least_cm);
  out.u16_le(distances.most_cm);
  out.u16_le(distances.heard_cm);
  out.u8(kUltrasound);
  out.zeros(2);  // its number, straight ahead
  out.u8(kVariance);
  out.u16_le(MavlinkUltrasonic::checksum_of(
      std::span(bytes).first(MavlinkUltrasonic::kHeadBytes + kPayloadBytes)));
  require(out.ok() && out.remaining() == 0);
  return bytes;
}

class MavlinkEncoder final : public PacketEncoder {
 public:
  explicit MavlinkEncoder(const description::SensorConfig& config) : config_(config) {}

  [[nodiscard]] std::uint64_t packet_ns() const override { return kCycleNs; }

  // Heard when its cycle is over.
  [[nodiscard]] std::vector<std::byte> packet(std::uint64_t begin_ns, std::uint64_t number,
                                              const RayCaster& rays, Random& random,
                                              std::vector<PointTruth>& truth) const override {
    const std::uint64_t end_ns = begin_ns + kCycleNs;
    const double time_s = static_cast<double>(end_ns) / 1e9;
    const SensorFrame frame = rays.frame_at(time_s);
    const int side_deg = static_cast<int>(kSidesOfSigma * config_.azimuth_sigma_deg);
    Ray nearest_ray{frame.origin, frame.direction({1, 0, 0})};
    Hit nearest;
    for (int degree = -side_deg; degree <= side_deg; ++degree) {
      const double azimuth = description::radians(degree);
      const Ray ray{frame.origin,
                    frame.direction({numeric::cos(azimuth), numeric::sin(azimuth), 0})};
      const Hit hit = rays.nearest(ray, time_s);
      if (hit.material != Material::kGround && hit.distance < nearest.distance) {
        nearest = hit;
        nearest_ray = ray;
      }
    }
    truth.push_back(rays.truth_of(nearest_ray, nearest));
    const double most_cm = config_.range_max_mm / 10.0;
    const double heard_cm =
        nearest.distance > most_cm / 100
            ? most_cm
            : std::clamp(100 * (nearest.distance + config_.sigma_m * random.bell()), 0.0, most_cm);
    return message_of(static_cast<std::uint32_t>(end_ns / 1'000'000),
                      static_cast<std::uint8_t>(number),
                      {.least_cm = static_cast<std::uint16_t>(config_.range_min_mm / 10),
                       .most_cm = static_cast<std::uint16_t>(most_cm),
                       .heard_cm = static_cast<std::uint16_t>(numeric::round(heard_cm))});
  }

 private:
  description::SensorConfig config_;
};

}  // namespace

std::unique_ptr<PacketEncoder> mavlink_encoder(const description::SensorConfig& config) {
  return std::make_unique<MavlinkEncoder>(config);
}

}  // namespace iog::tools
