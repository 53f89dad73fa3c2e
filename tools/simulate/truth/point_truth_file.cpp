#include "tools/simulate/truth/point_truth_file.hpp"

#include <array>
#include <cstddef>
#include <string_view>

#include "numeric/elementary.hpp"

namespace iog::tools {
namespace {

constexpr std::array<std::string_view, 5> kPointClassNames{"ground", "moving", "movable",
                                                           "infrastructure", "clutter"};

std::string millimetres(double metres) {
  return std::to_string(static_cast<std::int64_t>(numeric::round(metres * 1000)));
}

std::string place_of(const PointTruth& truth) {
  if (truth.what == PointClass::kClutter) {
    return ",,,";
  }
  return millimetres(truth.at.x) + ',' + millimetres(truth.at.y) + ',' + millimetres(truth.at.z) +
         ',' + millimetres(truth.height_m);
}

}  // namespace

PointTruthFile::PointTruthFile(const std::string& path) : file_(path) {
  file_.write("frame,time_us,port,point,class,thing,x_mm,y_mm,z_mm,height_mm\n");
}

void PointTruthFile::write(std::uint32_t frame, std::span<const SimulatedPacket> packets) {
  std::string rows;
  for (const SimulatedPacket& packet : packets) {
    const std::string where = std::to_string(frame) + ',' +
                              std::to_string(packet.datagram.time_us) + ',' +
                              std::to_string(packet.datagram.destination.port) + ',';
    for (std::size_t point = 0; point < packet.points.size(); ++point) {
      const PointTruth& truth = packet.points[point];
      if (truth.what == PointClass::kNothing) {
        continue;
      }
      rows += where + std::to_string(point) + ',' +
              std::string(kPointClassNames[static_cast<std::size_t>(truth.what)]) + ',' +
              std::to_string(truth.thing) + ',' + place_of(truth) + '\n';
    }
  }
  file_.write(std::string_view(rows));
}

}  // namespace iog::tools
