// The law of versions: as long as that of a tile stays, its classes do.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <gtest/gtest.h>
#include <map>

#include "window/window_view.hpp"

namespace iog::perception {

class KeptVersions {
 public:
  // After each frame.
  void look(const window::WindowView& view) {
    for (std::size_t slot = 0; slot < window::kSlotCount; ++slot) {
      if (!view.is_known(slot)) {
        continue;
      }
      Kept now{.version = view.version(slot)};
      view.copy_classes(slot, now.classes);
      const auto before = kept_.find(slot);
      if (before != kept_.end() && before->second.version == now.version) {
        ASSERT_EQ(before->second.classes, now.classes) << slot;
        ++stayed_;
      }
      EXPECT_NE(now.version, 0U);
      kept_.insert_or_assign(slot, now);
    }
  }

  [[nodiscard]] int stayed() const { return stayed_; }

 private:
  struct Kept {
    std::uint32_t version = 0;
    std::array<std::int8_t, geometry::kTileCells> classes{};
  };
  std::map<std::size_t, Kept> kept_;
  int stayed_ = 0;
};

}  // namespace iog::perception
