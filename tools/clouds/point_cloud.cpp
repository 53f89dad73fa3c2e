#include "tools/clouds/point_cloud.hpp"

#include <bit>
#include <cmath>
#include <cstdint>
#include <filesystem>
#include <span>

#include "tools/program/exit_status.hpp"
#include "tools/program/file.hpp"
#include "wire/byte_order.hpp"

namespace iog::tools {
namespace {

double float_at(std::span<const std::byte, 4> bytes) {
  return static_cast<double>(std::bit_cast<float>(wire::load_le32(bytes)));
}

}  // namespace

std::vector<std::byte> read_cloud_file(const std::string& path) {
  constexpr std::size_t kMostPointBytes = 128;
  std::error_code unknown;
  const std::uintmax_t size = std::filesystem::file_size(path, unknown);
  if (!unknown && size > kMostCloudPoints * kMostPointBytes) {
    throw UsageError(path + ": it has " + std::to_string(size) + " bytes; clouds of at most " +
                     std::to_string(kMostCloudPoints * kMostPointBytes) + " are read");
  }
  return read_file(path);
}

PointCloud read_cloud(const std::string& path, std::size_t numbers) {
  const std::size_t point_bytes = 4 * numbers;
  std::error_code unknown;
  const std::uintmax_t size = std::filesystem::file_size(path, unknown);
  if (!unknown && size > kMostCloudPoints * point_bytes) {
    throw UsageError(path + ": " + std::to_string(size / point_bytes) +
                     " points; no unit sees more than " + std::to_string(kMostCloudPoints) +
                     " in a turn");
  }
  const std::vector<std::byte> bytes = read_file(path);
  if (bytes.size() % point_bytes != 0) {
    throw UsageError(path + ": " + std::to_string(bytes.size()) +
                     " bytes are no number of points of " + std::to_string(point_bytes) + " bytes");
  }
  PointCloud cloud;
  cloud.points.reserve(bytes.size() / point_bytes);
  std::size_t negative = 0;  // reflectances
  for (auto rest = std::span<const std::byte>(bytes); !rest.empty();
       rest = rest.subspan(point_bytes)) {
    const CloudPoint point{float_at(rest.subspan<0, 4>()), float_at(rest.subspan<4, 4>()),
                           float_at(rest.subspan<8, 4>())};
    if (std::isfinite(point.x) && std::isfinite(point.y) && std::isfinite(point.z)) {
      cloud.points.push_back(point);
    } else {
      ++cloud.not_finite;
    }
    negative += float_at(rest.subspan<12, 4>()) < 0 ? 1U : 0U;
  }
  if (numbers == 4 && negative > bytes.size() / point_bytes / 8) {
    throw UsageError(path + ": " + std::to_string(negative) +
                     " points have a reflectance below 0, so its points are not of four numbers "
                     "as KITTI's; convert files of three or five numbers a point to PCD");
  }
  return cloud;
}

}  // namespace iog::tools
