// The undo log for tasks that change data in place. A partially completed task can be undone and
// repeated.
//
// Each helper has one image. Before an item changes data, the helper copies this data into the
// image and then records the number of the item. Before core 0 repeats an item of a lost core, it
// restores the image that belongs to the item. If the item has no image, the item has not changed
// any data yet. Core 0 needs no image because its items are never repeated.
//
// Core 0 reads a helper's image only after the helper has stopped. If core 0 then sees one of the
// helper's stores, core 0 also sees all earlier stores of this helper. A compiler barrier between
// the stores is therefore enough.
#pragma once

#include <array>
#include <atomic>
#include <cstddef>
#include <cstdint>

#include "hal/cores.hpp"
#include "require/require.hpp"

namespace iog::work {

// A compiler barrier between two stores of the current core. After this core has stopped, core 0
// sees all stores before the barrier if it sees any store after the barrier.
inline void keep_order() { std::atomic_signal_fence(std::memory_order_seq_cst); }

// If the image is large, the object must be in static memory.
template <typename Image>
class BeforeImages {
 public:
  // Clears all images. Core 0 must call begin() before a round that changes data in place.
  void begin() {
    for (Place& place : places_) {
      place.item.store(kNone, std::memory_order_relaxed);
    }
  }

  // Returns the image that a core fills in after it has claimed an item. Returns null if the core
  // needs no image.
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

  // If a core was lost while it ran this item, returns the image that this core saved. Returns null
  // if the item did not change any data. Core 0 calls of_lost() before it repeats an item.
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
