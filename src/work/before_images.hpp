// The undo log for tasks that change data in place. A partially completed task can be undone and
// repeated.
//
// Each helper has one image. Before an item changes data, the helper copies the data into the image
// and then records the item's number. Before core 0 repeats an item of a lost core, it restores the
// data from the item's image. If the item has no image, it has not changed any data yet. Core 0
// needs no image because its items are never repeated.
//
// Core 0 reads a helper's image only after the helper has stopped. If core 0 then sees one of the
// helper's stores, it also sees all of the helper's earlier stores. A compiler barrier between the
// stores is therefore enough.
#pragma once

#include <array>
#include <atomic>
#include <cstddef>
#include <cstdint>

#include "hal/cores.hpp"
#include "require/require.hpp"

namespace iog::work {

// A compiler barrier between two stores of the calling core. Once this core has stopped, core 0
// cannot see a store after the barrier without also seeing all stores before it.
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

  // Returns the image in which a core saves an item's data, or null if the core needs no image.
  [[nodiscard]] Image* of(std::size_t core) {
    return core == 0 ? nullptr : &places_[core - 1].image;
  }

  // Records that a helper's image of an item is complete. The item may change data only after this
  // call. Core 0 must not call keep().
  void keep(std::size_t core, std::size_t item) {
    require(core > 0);
    keep_order();
    places_[core - 1].item.store(static_cast<std::uint32_t>(item), std::memory_order_relaxed);
    keep_order();
  }

  // Returns the image that a lost core saved for this item, or null if the item has not changed any
  // data. Core 0 calls of_lost() before it repeats the item.
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
