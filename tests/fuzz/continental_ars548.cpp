// A Continental ARS548: the input's first byte says how many detections a list claims, and the rest
// are its bytes, filled up with zeros behind a head that is right.
#include "lidar/continental_ars548.hpp"

#include <algorithm>
#include <vector>

#include "fakes/ars548_list.hpp"
#include "law.hpp"

namespace iog::fuzz {
namespace {

using lidar::ContinentalArs548;

void check(std::span<const std::byte> list) {
  ContinentalArs548 decoder;
  if (decoder.decode(list) != lidar::DecodeStatus::kOk) {
    return;
  }
  std::uint32_t count = 0;
  decoder.for_each_point([&](const lidar::ScanPoint& point) {
    law(point.azimuth_ticks < ContinentalArs548::kTicksPerTurn, "an azimuth is within a turn");
    law(point.layer < ContinentalArs548::kElevationsDeg.size(), "a layer is one of the format's");
    law(point.range_mm <= lidar::kMaxRangeMm, "a range is one that a unit may have");
    law(point.echo == 0, "a detection is nobody's second echo");
    ++count;
  });
  law(count == decoder.info().point_count, "as many points as it says");
  law(count <= ContinentalArs548::kMostDetections, "no more than there are places");
  law(decoder.decode(list.first(list.size() - 1)) == lidar::DecodeStatus::kWrongLength,
      "a shorter list is refused");
}

}  // namespace
}  // namespace iog::fuzz

int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  using iog::lidar::ContinentalArs548;
  iog::wire::ByteReader in(iog::fuzz::input_bytes(data, size));
  const std::size_t count = std::size_t{4} * in.u8();
  iog::tests::Ars548List list;
  list.detections.resize(std::min(count, ContinentalArs548::kMostDetections));
  std::vector<std::byte> bytes = list.bytes();
  const auto given = in.bytes(std::min(in.remaining(), bytes.size() - 36));
  std::ranges::copy(given, bytes.begin() + 36);
  iog::fuzz::check(bytes);
  iog::fuzz::check(iog::fuzz::input_bytes(data, size));
  return 0;
}
