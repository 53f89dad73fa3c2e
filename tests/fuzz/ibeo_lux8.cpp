// IbeoLux8 on two messages, one after the other.
#include "lidar/ibeo_lux8.hpp"

#include <vector>

#include "law.hpp"
#include "lidar/ibeo_lux.hpp"

namespace iog::fuzz {
namespace {

std::vector<std::uint8_t> layers_of(const lidar::IbeoLux8& decoder) {
  std::vector<std::uint8_t> layers;
  decoder.for_each_point([&](const lidar::ScanPoint& point) {
    const bool is_seen =
        point.azimuth_ticks <= lidar::IbeoLux8::kLeftmostTicks ||
        point.azimuth_ticks >= lidar::IbeoLux8::kTicksPerTurn + lidar::IbeoLux8::kRightmostTicks;
    law(is_seen, "an azimuth is within the field of view");
    law(point.layer < lidar::IbeoLux8::kElevationsDeg.size(), "a layer has an elevation");
    layers.push_back(point.layer);
  });
  law(layers.size() == decoder.info().point_count, "as many points as it says");
  return layers;
}

void check(std::span<const std::byte> first, std::span<const std::byte> second) {
  lidar::IbeoLux8 used;
  static_cast<void>(used.decode(first));
  lidar::IbeoLux8 fresh;
  const lidar::DecodeStatus status = fresh.decode(second);
  law(used.decode(second) == status, "the message before has no influence");
  lidar::IbeoLux four;
  const bool is_message = four.decode(second) == lidar::DecodeStatus::kOk;
  law(is_message || status != lidar::DecodeStatus::kOk, "it is a message of a LUX, too");
  if (status != lidar::DecodeStatus::kOk) {
    return;
  }
  const std::vector<std::uint8_t> layers = layers_of(fresh);
  law(layers == layers_of(used), "nor on the points");
  std::size_t number = 0;
  bool is_one_side = true;
  four.for_each_point([&](const lidar::ScanPoint& point) {
    is_one_side =
        is_one_side && layers[number] % 4 == point.layer && layers[number] / 4 == layers[0] / 4;
    ++number;
  });
  law(is_one_side, "all points are of one side of the mirror");
}

}  // namespace
}  // namespace iog::fuzz

int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  iog::wire::ByteReader in(iog::fuzz::input_bytes(data, size));
  const auto first = iog::fuzz::next_piece(in);
  iog::fuzz::check(first, in.bytes(in.remaining()));
  return 0;
}
