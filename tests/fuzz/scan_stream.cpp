// ScanStream on bytes that come in pieces, and all at once.
#include "tools/relay/scan_stream.hpp"

#include <algorithm>
#include <vector>

#include "law.hpp"
#include "lidar/ibeo_lux.hpp"

namespace iog::fuzz {
namespace {

struct Heard {
  std::vector<tools::LuxScan> scans;
  tools::ScanStream stream;

  void take(std::span<const std::byte> bytes) {
    const std::size_t before = stream.held_bytes();
    stream.take(bytes, [this](tools::LuxScan scan) { scans.push_back(std::move(scan)); });
    law(stream.held_bytes() <= before + bytes.size(), "nothing is held that did not come");
    law(stream.held_bytes() < tools::ScanStream::kMostScanBytes, "less than a message is held");
  }
};

bool same(const tools::LuxScan& a, const tools::LuxScan& b) {
  return a.scan_number == b.scan_number && a.points == b.points;
}

// Each scan on its way to the target.
void check_datagrams(const std::vector<tools::LuxScan>& scans) {
  for (const tools::LuxScan& scan : scans) {
    std::size_t points = 0;
    for (const std::vector<std::byte>& datagram : tools::split_lux_scan(scan)) {
      lidar::IbeoLux decoder;
      law(decoder.decode(datagram) == lidar::DecodeStatus::kOk, "the target takes it");
      law(datagram.size() <= tools::kMaxLuxDatagramBytes, "a datagram is no fragment");
      points += decoder.info().point_count;
    }
    law(points == scan.points.size(), "no point is lost");
  }
}

}  // namespace

void check(std::span<const std::byte> input) {
  wire::ByteReader in(input);
  const std::size_t piece = in.u8() + std::size_t{1};
  const auto bytes = in.bytes(in.remaining());
  Heard whole;
  whole.take(bytes);
  Heard cut;
  for (auto rest = bytes; !rest.empty(); rest = rest.subspan(std::min(piece, rest.size()))) {
    cut.take(rest.first(std::min(piece, rest.size())));
  }
  law(cut.stream.counts() == whole.stream.counts(), "it counts the same, however they are cut");
  law(std::ranges::equal(cut.scans, whole.scans, same), "and hears the same");
  check_datagrams(whole.scans);
}

}  // namespace iog::fuzz
