// What is in a map block.
#include <algorithm>
#include <ctime>
#include <fstream>
#include <iomanip>
#include <sstream>

#include "map/block.hpp"
#include "map/layer.hpp"
#include "tools/info/file_summary.hpp"
#include "tools/map/refusal_text.hpp"
#include "tools/program/exit_status.hpp"
#include "tools/program/file.hpp"
#include "tools/program/fixed.hpp"
#include "tools/program/hexadecimal.hpp"
#include "tools/program/printable.hpp"
#include "tools/program/table.hpp"

namespace iog::tools {
namespace {

std::string day_of(std::uint32_t date_s) {
  if (date_s == 0) {
    return "not known";
  }
  const std::time_t time = date_s;
  std::tm parts{};
  gmtime_r(&time, &parts);
  std::ostringstream text;
  text << std::put_time(&parts, "%Y-%m-%d");
  return text.str();
}

std::string degrees(std::int64_t units) { return fixed(static_cast<double>(units) / 1e9, 9); }

std::string metres(std::int64_t cm) { return fixed(static_cast<double>(cm) / 100, 2); }

std::string features_of(const map::Block& block) {
  std::uint32_t buildings = 0;
  std::uint64_t vertices = 0;
  for (std::uint32_t number = 0; number < block.feature_count(); ++number) {
    const map::Feature feature = block.feature(number);
    buildings += feature.kind() == map::Kind::kBuilding ? 1U : 0U;
    vertices += feature.edge_count();
  }
  return std::to_string(buildings) + " of buildings, " +
         std::to_string(block.feature_count() - buildings) + " of roads, " +
         std::to_string(vertices) + " vertices";
}

std::string source_of(const map::Block& block) {
  const bool is_osm = block.source() == map::Source::kOpenStreetMap;
  return is_osm ? "OpenStreetMap" : "surveyed";
}

// Even if the poses state exactly where the map is.
std::string words_of_inexact(std::uint32_t accuracy_mm) {
  constexpr pose::Sigma kExact{.position_mm = 0, .heading_10urad = 0};
  const auto fitting = std::ranges::find_if(geometry::kCellSizesMm, [&](std::uint16_t cell_mm) {
    return map::blur_radius(accuracy_mm, kExact, cell_mm) <= map::kHalo;
  });
  if (fitting == geometry::kCellSizesMm.end()) {
    return "no target accepts this accuracy: it blurs the map by more than " +
           std::to_string(map::kHalo) + " cells";
  }
  return *fitting <= geometry::kUsualCellMm
             ? std::string()
             : "only targets with cells of " + std::to_string(*fitting) +
                   " mm or more accept this accuracy";
}

}  // namespace

std::string summary_of_block(std::span<const std::uint8_t> bytes) {
  std::string text = row("kind", "map block, " + std::to_string(bytes.size()) + " bytes");
  const map::Refusal refusal = map::check(bytes);
  text += row("check", refusal == map::Refusal::kNone
                           ? "sound"
                           : std::string("refused: ") + refusal_text(refusal));
  if (refusal != map::Refusal::kNone) {
    return text;
  }
  const map::Block block(bytes);
  const map::BoxCm extent = block.extent();
  const std::string inexact = words_of_inexact(block.accuracy_mm());
  return text +
         row("origin", degrees(block.latitude()) + ", " + degrees(block.longitude()) +
                           ", its name " + hex(block.origin(), 16)) +
         row("extent", "east " + metres(extent.low.x) + " to " + metres(extent.high.x) +
                           " m, north " + metres(extent.low.y) + " to " + metres(extent.high.y) +
                           " m") +
         row("features", features_of(block)) + row("source", source_of(block)) +
         row("date", day_of(block.date_s())) +
         row("accuracy", std::to_string(block.accuracy_mm()) + " mm") +
         row_if(!inexact.empty(), "INEXACT?", inexact) + row("crc-32", hex(block.crc())) +
         row("attribution", printable(std::string(block.attribution())));
}

std::string summary_of_block_file(const std::string& path) {
  const std::vector<std::byte> bytes = read_file(path);
  return summary_of_block({reinterpret_cast<const std::uint8_t*>(bytes.data()), bytes.size()});
}

bool is_block_file(const std::string& path) {
  char magic[4] = {};
  std::ifstream(path, std::ios::binary).read(magic, sizeof magic);
  return std::string_view(magic, sizeof magic) == "IOGM";
}

void demand_accepted_block(const std::string& path) {
  if (!is_block_file(path)) {
    return;
  }
  const std::vector<std::byte> bytes = read_file(path);
  const map::Refusal refusal =
      map::check({reinterpret_cast<const std::uint8_t*>(bytes.data()), bytes.size()});
  if (refusal != map::Refusal::kNone) {
    throw CheckFailed(path + ": the target would refuse this map: " + refusal_text(refusal));
  }
}

}  // namespace iog::tools
