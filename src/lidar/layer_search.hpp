// Finds the layer whose elevation is nearest to that of a point.
//
// The first guess assumes equally spaced layers, which is nearly correct for most units. If the
// guess is wrong, a binary search finds the layer. For 128 layers, the binary search takes seven
// steps.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>

namespace iog::lidar {

class LayerSearch {
 public:
  // The elevation tolerance of a single layer: half a degree, in units of 1/3,200 degree.
  static constexpr std::int32_t kAlone = 1'600;

  LayerSearch() = default;
  // `rising` must contain at least one elevation. The elevations must be in ascending order and
  // span at most a quarter turn, which is less than 2^20 units. The array must outlive the search.
  explicit LayerSearch(std::span<const std::int32_t> rising) : rising_(rising) {
    const std::size_t last = rising.size() - 1;
    lowest_ = rising.front() - (last == 0 ? kAlone : (rising[1] - rising[0]) / 2);
    highest_ = rising.back() + (last == 0 ? kAlone : (rising[last] - rising[last - 1]) / 2);
    if (last > 0) {
      const auto height = static_cast<std::uint64_t>(rising.back() - rising.front());
      layers_per_part_ =
          static_cast<std::uint32_t>((std::uint64_t{last} << kFractionBits) / height);
    }
  }

  // Returns true if the elevation is between the lowest and highest layers, or at most half a layer
  // spacing beyond them.
  [[nodiscard]] bool sees(std::int32_t elevation) const {
    return elevation >= lowest_ && elevation <= highest_;
  }

  // Returns the nearest layer. If two layers are equally near, returns the upper one.
  [[nodiscard]] std::size_t nearest(std::int32_t elevation) const {
    const std::size_t layer = guess(elevation);
    return is_nearest(layer, elevation) ? layer : found(elevation);
  }

 private:
  // Layers are at least one elevation unit apart, so layers_per_part_ is at most 1. Elevation
  // differences are below 2^20 units, so the product of a difference and layers_per_part_ fits in
  // 64 bits.
  static constexpr int kFractionBits = 31;

  [[nodiscard]] std::size_t guess(std::int32_t elevation) const {
    const std::int32_t above = elevation - rising_.front();
    if (above <= 0) {
      return 0;
    }
    const std::uint64_t layers = static_cast<std::uint64_t>(above) * layers_per_part_;
    const auto layer = static_cast<std::uint32_t>(
        (layers + (std::uint64_t{1} << (kFractionBits - 1))) >> kFractionBits);
    return layer < rising_.size() ? layer : rising_.size() - 1;
  }

  [[nodiscard]] bool is_below(std::int32_t elevation, std::size_t upper) const {
    return 2 * elevation < rising_[upper - 1] + rising_[upper];
  }

  [[nodiscard]] bool is_nearest(std::size_t layer, std::int32_t elevation) const {
    return (layer == 0 || !is_below(elevation, layer)) &&
           (layer + 1 == rising_.size() || is_below(elevation, layer + 1));
  }

  [[nodiscard]] std::size_t found(std::int32_t elevation) const {
    std::size_t first = 0;
    for (std::size_t end = rising_.size(); end - first > 1;) {
      const std::size_t middle = first + (end - first) / 2;
      if (is_below(elevation, middle)) {
        end = middle;
      } else {
        first = middle;
      }
    }
    return first;
  }

  std::span<const std::int32_t> rising_;
  std::int32_t lowest_ = 0;
  std::int32_t highest_ = 0;
  std::uint32_t layers_per_part_ = 0;
};

}  // namespace iog::lidar
