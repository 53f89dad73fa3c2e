// A simulated Ouster: packets of 16 columns as it would send them, in its mode and profile
// (lidar/ouster.hpp). Its column 0 is behind it.
#include <algorithm>
#include <optional>

#include "lidar/ouster.hpp"
#include "numeric/elementary.hpp"
#include "require/require.hpp"
#include "tools/formats/capture/made_capture.hpp"
#include "tools/simulate/scanners/encoders.hpp"
#include "tools/simulate/scanners/spinning_beams.hpp"
#include "wire/byte_writer.hpp"

namespace iog::tools {
namespace {

using lidar::OusterPacket;

constexpr std::uint8_t kOusterReflectivity = 40;
constexpr std::uint16_t kNearInfrared = 100;
constexpr std::uint16_t kLidarPacket = 1;

// In the profile's units, of 8 mm with RNG15; 0: nothing came back.
std::uint32_t range_units(const lidar::OusterProfile& profile,
                          const std::optional<double>& range_m) {
  if (!range_m) {
    return 0;
  }
  const double unit_mm = 1U << profile.range_shift;
  const auto most = static_cast<double>(profile.range_mask);
  return static_cast<std::uint32_t>(
      numeric::round(std::clamp(*range_m * 1000 / unit_mm, 1.0, most)));
}

class OusterEncoder final : public PacketEncoder {
 public:
  OusterEncoder(const description::SensorConfig& config, const lidar::OusterProfile& profile)
      : mode_(config.mode), profile_(profile), beams_(config) {}

  [[nodiscard]] std::uint64_t packet_ns() const override {
    return OusterPacket::kColumns * 1'000'000'000 /
           (std::uint64_t{mode_.columns_per_turn} * mode_.turns_per_second);
  }

  // number says which columns of which turn they are.
  [[nodiscard]] std::vector<std::byte> packet(std::uint64_t begin_ns, std::uint64_t number,
                                              const RayCaster& rays, Random& random,
                                              std::vector<PointTruth>& truth) const override {
    const std::uint64_t packets_per_turn = mode_.columns_per_turn / OusterPacket::kColumns;
    const auto frame = static_cast<std::uint16_t>(number / packets_per_turn + 1);
    const auto first =
        static_cast<std::uint32_t>(number % packets_per_turn * OusterPacket::kColumns);
    std::vector<std::byte> bytes(profile_.header_bytes + profile_.footer_bytes +
                                 OusterPacket::kColumns * profile_.column_bytes(beams_.layers()));
    wire::ByteWriter out(bytes);
    if (!profile_.is_legacy()) {
      out.u16_le(kLidarPacket);
      out.u16_le(frame);
      out.zeros(profile_.header_bytes - 4);
    }
    for (std::uint32_t i = 0; i < OusterPacket::kColumns; ++i) {
      const std::uint64_t fires_ns = begin_ns + packet_ns() * i / OusterPacket::kColumns;
      write_column_head(kDriveStartUs * 1'000 + fires_ns, frame, first + i, out);
      write_pixels(first + i, fires_ns, rays, random, truth, out);
      if (profile_.is_legacy()) {
        out.u32_le(0xFFFF'FFFF);  // measured
      }
    }
    out.zeros(profile_.footer_bytes);
    require(out.ok() && out.remaining() == 0);
    return bytes;
  }

 private:
  void write_column_head(std::uint64_t time_ns, std::uint16_t frame, std::uint32_t column,
                         wire::ByteWriter& out) const {
    out.u64_le(time_ns);
    out.u16_le(static_cast<std::uint16_t>(column));
    if (profile_.is_legacy()) {
      out.u16_le(frame);
      out.u32_le(column * (OusterPacket::kEncoderPerTurn / mode_.columns_per_turn));
    } else {
      out.u16_le(1);  // measured
    }
  }
  void write_pixels(std::uint32_t column, std::uint64_t fires_ns, const RayCaster& rays,
                    Random& random, std::vector<PointTruth>& truth, wire::ByteWriter& out) const {
    constexpr std::uint32_t kTurn = OusterPacket::kTicksPerTurn;
    const std::uint32_t turned =
        (column * kTurn + mode_.columns_per_turn / 2U) / mode_.columns_per_turn + kTurn / 2;
    for (std::size_t row = 0; row < beams_.layers(); ++row) {
      const Measured measured =
          beams_.measure(row, static_cast<std::int32_t>(turned % kTurn), fires_ns, rays, random);
      truth.push_back(measured.truth);
      const std::uint32_t range = range_units(profile_, measured.range_m);
      const std::uint8_t reflectivity = range == 0 ? std::uint8_t{0} : kOusterReflectivity;
      if (profile_.returns() == 2) {
        truth.emplace_back();  // no second return
        out.u32_le(range | std::uint32_t{reflectivity} << 24);
        out.zeros(8);  // the second return, signals
        out.u32_le(kNearInfrared);
      } else if (profile_.pixel_bytes == 4) {
        out.u16_le(static_cast<std::uint16_t>(range));
        out.u8(reflectivity);
        out.u8(0);  // near infrared
      } else {
        out.u32_le(range);
        out.u8(reflectivity);
        out.zeros(7);  // signal, near infrared
      }
    }
  }

  lidar::TurnMode mode_;
  lidar::OusterProfile profile_;
  SpinningBeams beams_;
};

}  // namespace

std::unique_ptr<PacketEncoder> ouster_encoder(const description::SensorConfig& config,
                                              const lidar::OusterProfile& profile) {
  return std::make_unique<OusterEncoder>(config, profile);
}

}  // namespace iog::tools
