#include "lidar/ibeo_lux8.hpp"

#include "wire/byte_order.hpp"

namespace iog::lidar {

DecodeStatus IbeoLux8::decode(std::span<const std::byte> datagram) {
  constexpr std::uint16_t kUpsideDown = 0x8000;
  constexpr std::uint16_t kRearSide = 0x0400;
  *this = IbeoLux8{};
  const DecodeStatus status = scan_.decode(datagram);
  if (status != DecodeStatus::kOk) {
    return status;
  }
  const auto body = datagram.subspan<IbeoLux::kHeaderBytes, IbeoLux::kScanBytes>();
  if ((wire::load_le16(body.subspan<2, 2>()) & kUpsideDown) != 0) {
    return DecodeStatus::kOtherUnit;
  }
  const Sector& sector = scan_.info().sector;
  const std::int32_t right = sector.first_ticks > kTicksPerTurn / 2
                                 ? sector.first_ticks - kTicksPerTurn
                                 : sector.first_ticks;
  if (right < kRightmostTicks || right + sector.width_ticks > kLeftmostTicks) {
    return DecodeStatus::kWrongAngle;
  }
  const bool is_rear = (wire::load_le16(body.subspan<42, 2>()) & kRearSide) != 0;
  first_layer_ = is_rear ? kLayersOfSide : std::uint8_t{0};
  return DecodeStatus::kOk;
}

}  // namespace iog::lidar
