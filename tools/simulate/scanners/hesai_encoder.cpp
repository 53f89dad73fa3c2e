// A simulated Hesai: packets as it would send them while its head turns ten times a second, with
// the azimuth at which each block fires (lidar/hesai.hpp).
#include <algorithm>
#include <ctime>
#include <initializer_list>
#include <optional>
#include <span>

#include "lidar/hesai.hpp"
#include "numeric/elementary.hpp"
#include "require/require.hpp"
#include "tools/formats/capture/made_capture.hpp"
#include "tools/simulate/scanners/encoders.hpp"
#include "tools/simulate/scanners/spinning_beams.hpp"
#include "wire/byte_writer.hpp"

namespace iog::tools {
namespace {

constexpr std::uint64_t kHesaiTurnNs = 1'000'000'000 / kTurnsPerSecond;
constexpr std::uint64_t kHesaiTurn = lidar::HesaiPacket::kTicksPerTurn;
constexpr std::uint16_t kRpm = 60 * kTurnsPerSecond;
constexpr std::uint8_t kStrongest = 0x37;
constexpr std::uint8_t kMaker = 0x42;
constexpr std::uint8_t kLaterBankFirst = 1;
constexpr std::uint16_t kBlockFlag = 0xEEFF;  // of a unit without a header
constexpr std::uint8_t kHesaiReflectivity = 40;
constexpr std::uint8_t kSureOfIt = 255;

void write_utc(std::uint64_t unix_s, unsigned years_before, wire::ByteWriter& out) {
  const auto seconds = static_cast<std::time_t>(unix_s);
  std::tm utc{};
  gmtime_r(&seconds, &utc);
  out.u8(static_cast<std::uint8_t>(static_cast<unsigned>(utc.tm_year) + 1900U - years_before));
  out.u8(static_cast<std::uint8_t>(utc.tm_mon + 1));
  for (const int field : {utc.tm_mday, utc.tm_hour, utc.tm_min, utc.tm_sec}) {
    out.u8(static_cast<std::uint8_t>(field));
  }
}

// 0: nothing came back.
std::uint16_t range_units(const std::optional<double>& range_m, std::uint32_t unit_mm) {
  if (!range_m) {
    return 0;
  }
  const double units = *range_m * 1000 / unit_mm;
  return static_cast<std::uint16_t>(numeric::round(std::clamp(units, 1.0, 65'535.0)));
}

class HesaiEncoder final : public PacketEncoder {
 public:
  HesaiEncoder(const description::SensorConfig& config, const lidar::HesaiUnit& unit)
      : unit_(unit), beams_(config) {}

  [[nodiscard]] std::uint64_t packet_ns() const override {
    return unit_.blocks * static_cast<std::uint64_t>(unit_.firing_ns);
  }

  // The head looks forward when the drive begins. The nearest return of each beam.
  [[nodiscard]] std::vector<std::byte> packet(std::uint64_t begin_ns, std::uint64_t number,
                                              const RayCaster& rays, Random& random,
                                              std::vector<PointTruth>& truth) const override {
    std::vector<std::byte> bytes(unit_.bytes + unit_.may_follow_bytes);
    wire::ByteWriter out(bytes);
    write_head(out);
    std::uint64_t fires_ns = begin_ns;
    for (std::size_t block = 0; block < unit_.blocks; ++block) {
      fires_ns = begin_ns + block * static_cast<std::uint64_t>(unit_.firing_ns);
      const std::uint64_t turned = fires_ns % kHesaiTurnNs;
      const std::uint64_t azimuth =
          (turned * kHesaiTurn + kHesaiTurnNs / 2) / kHesaiTurnNs % kHesaiTurn;
      if (unit_.flag_bytes != 0) {
        out.u16_le(kBlockFlag);
      }
      out.u16_le(static_cast<std::uint16_t>(azimuth));
      for (std::size_t laser = 0; laser < unit_.lasers; ++laser) {
        const Measured measured =
            fires(block, laser)
                ? beams_.measure(laser, static_cast<std::int32_t>(azimuth), fires_ns, rays, random)
                : Measured{};
        truth.push_back(measured.truth);
        const std::uint16_t range = range_units(measured.range_m, unit_.distance_unit_mm);
        out.u16_le(range);
        out.u8(range == 0 ? std::uint8_t{0} : kHesaiReflectivity);
        if (unit_.channel_bytes == 4) {
          out.u8(range == 0 ? std::uint8_t{0} : kSureOfIt);
        }
      }
    }
    const std::uint64_t stamped_ns = unit_.is_first_stamped ? begin_ns : fires_ns;
    const auto block_ns = static_cast<std::int64_t>(kDriveStartUs * 1'000 + stamped_ns);
    write_tail(static_cast<std::uint64_t>(block_ns - unit_.stamped_block_ns) / 1'000, number, out);
    require(out.ok() && out.remaining() == 0);
    return bytes;
  }

 private:
  // Of the later units: with a version of it, and a tail whose years count from 1900.
  [[nodiscard]] bool has_long_head() const { return unit_.header_bytes == 12; }
  // The first block is of the later bank, the second of the first.
  [[nodiscard]] bool fires(std::size_t block, std::size_t laser) const {
    return unit_.bank_lasers == 0 || laser / unit_.bank_lasers != block % 2;
  }
  void write_head(wire::ByteWriter& out) const {
    if (unit_.header_bytes == 0) {
      return;
    }
    const auto unit_mm = static_cast<std::uint8_t>(unit_.distance_unit_mm);
    constexpr std::uint8_t kFirstIsStrongest = 2;
    const auto lasers = static_cast<std::uint8_t>(unit_.lasers);
    const auto blocks = static_cast<std::uint8_t>(unit_.blocks);
    const auto write = [&](std::initializer_list<std::uint8_t> bytes) {
      out.bytes(std::as_bytes(std::span(bytes.begin(), bytes.size())));
    };
    write({0xEE, 0xFF});
    if (has_long_head()) {
      // Version, reserved, lasers, blocks, which block is first, unit, returns, flags.
      write({unit_.model[0], unit_.model[1], 0, 0, lasers, blocks, kFirstIsStrongest, unit_mm, 1,
             unit_.flags});
    } else {
      // Lasers, blocks, returns, unit, reserved.
      write({lasers, blocks, 0, unit_mm, 0, 0});
    }
  }
  void write_tail(std::uint64_t stamp_us, std::uint64_t number, wire::ByteWriter& out) const {
    constexpr std::uint64_t kSecondUs = 1'000'000;
    const auto in_second = static_cast<std::uint32_t>(stamp_us % kSecondUs);
    const std::size_t tail = unit_.block_at(unit_.blocks) - unit_.flag_bytes;
    const unsigned years_before = has_long_head() ? 1900 : 2000;
    if (unit_.mode_at < unit_.time_at) {
      // Reserved, state, and between them which bank is the first.
      const bool has_banks = unit_.bank_lasers != 0;
      out.zeros((has_banks ? unit_.bank_at : unit_.mode_at) - tail);
      if (has_banks) {
        out.u8(kLaterBankFirst);
        out.zeros(unit_.mode_at - unit_.bank_at - 1);
      }
      out.u8(kStrongest);
      out.u16_le(kRpm);
      write_utc(stamp_us / kSecondUs, years_before, out);
      out.u32_le(in_second);
      out.u8(kMaker);
    } else {
      out.zeros(unit_.time_at - 2 - tail);
      out.u16_le(kRpm);
      out.u32_le(in_second);
      out.u8(kStrongest);
      out.u8(kMaker);
      write_utc(stamp_us / kSecondUs, years_before, out);
    }
    out.u32_le(static_cast<std::uint32_t>(number));
    out.zeros(out.remaining());  // checksum, signature
  }

  lidar::HesaiUnit unit_;
  SpinningBeams beams_;
};

}  // namespace

std::unique_ptr<PacketEncoder> hesai_encoder(const description::SensorConfig& config,
                                             const lidar::HesaiUnit& unit) {
  return std::make_unique<HesaiEncoder>(config, unit);
}

}  // namespace iog::tools
