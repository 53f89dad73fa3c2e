// The undo log for tasks that change data in place. A partially completed task can be undone and
// repeated.
//
// Each helper has one image. The helper copies the data that its item is about to change into the
// image, records the number of the item, and only then changes the data. Before core 0 repeats an
// item of a lost core, core 0 restores the image that belongs to the item. If no image belongs to
// the item, no data was changed yet. Core 0 needs no image, because its items are never repeated.
//
// Core 0 reads a helper's image only after the helper has ended. The end of the helper has the
// effect of a signal. If a later store of the helper is visible, its earlier stores are also
// visible. Therefore, a compiler barrier between the stores is enough.
#pragma once

#include <array>
#include <atomic>
#include <cstddef>
#include <cstdint>

#include "hal/cores.hpp"
#include "require/require.hpp"

namespace iog::work {

// A compiler barrier between two stores of the current core. If core 0 sees any store after the
// barrier when this core has ended, core 0 also sees all stores before the barrier.
inline void keep_order() { std::atomic_signal_fence(std::memory_order_seq_cst); }

// The object must be in static memory if the image is large.
template <typename Image>
class BeforeImages {
 public:
  // Clears all images. Core 0 must call begin() before a round that changes data in place.
  void begin() {
    for (Place& place : places_) {
      place.item.store(kNone, std::memory_order_relaxed);
    }
  }

  // Returns the image that a core fills in after it has claimed an item, or null if the core needs
  // no image.
  [[nodiscard]] Image* of(std::size_t core) {
    return core == 0 ? nullptr : &places_[core - 1].image;
  }

  // Marks a helper's image as complete. A helper (not core 0) calls keep() for an item. After the
  // call, the item may change data.
  void keep(std::size_t core, std::size_t item) {
    require(core > 0);
    keep_order();
    places_[core - 1].item.store(static_cast<std::uint32_t>(item), std::memory_order_relaxed);
    keep_order();
  }

  // Returns the image of the core that was lost while it ran this item, or null if no data was
  // changed. Core 0 calls of_lost() before it repeats an item.
  [[nodiscard]] const Image* of_lost(std::size_t item) const {
    for (const Place& place : places_) {
      if (place.item.load(std::memory_order_relaxed) == item) {
        return &place.image;
      }
    }
    return nullptr;
  }

 private:
  static constexpr std::uint32_t kNone = 0xFFFF'FFFF;

  struct alignas(64) Place {
    std::atomic<std::uint32_t> item{kNone};
    Image image{};
  };

  std::array<Place, hal::kMaxCores - 1> places_{};
};

}  // namespace iog::work
