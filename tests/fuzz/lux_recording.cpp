// The reader of raw LUX recordings: whatever it finds goes to the wire and is accepted there.
#include "law.hpp"
#include "lidar/ibeo_lux.hpp"
#include "tools/formats/lux/lux_scan.hpp"
#include "tools/formats/lux/lux_stream.hpp"

namespace iog::fuzz {

void check(std::span<const std::byte> input) {
  const tools::LuxStream stream = tools::read_lux_stream(input);
  law(stream.skipped_bytes <= input.size(), "no more is skipped than there was");
  for (const tools::LuxScan& scan : stream.scans) {
    std::size_t points = 0;
    for (const auto& message : tools::split_lux_scan(scan)) {
      lidar::IbeoLux decoder;
      law(decoder.decode(message) == lidar::DecodeStatus::kOk, "what was read can be sent");
      points += decoder.info().point_count;
    }
    law(points == scan.points.size(), "with all its points");
  }
}

}  // namespace iog::fuzz
