// What items change in place, as it was before: so that an item that was left half done can be done
// again from its start.
//
// Each helper has one image. It stores there what its item is about to change, says of which item
// that is, and only then changes it. Before an item is done again, the image of the lost core
// is put back if it is of this item; if none is, nothing was changed yet. Core 0 needs no image:
// its items are never done again.
//
// Core 0 reads the image of a helper when that has ended. To a core's own stores its end is what a
// signal is: what it stored first is there if what it stored later is. So it is enough that the
// compiler keeps the order.
#pragma once

#include <array>
#include <atomic>
#include <cstddef>
#include <cstdint>

#include "hal/cores.hpp"
#include "require/require.hpp"

namespace iog::work {

// What is stored before this is stored before what is stored after it, as core 0 sees it once this
// core has ended.
inline void keep_order() { std::atomic_signal_fence(std::memory_order_seq_cst); }

// Belongs into static memory if the image is large.
template <typename Image>
class BeforeImages {
 public:
  // Core 0, before a round that changes in place: no image is of any of its items.
  void begin() {
    for (Place& place : places_) {
      place.item.store(kNone, std::memory_order_relaxed);
    }
  }

  // A core that has taken an item: where it makes its image. Null: it needs none.
  [[nodiscard]] Image* of(std::size_t core) {
    return core == 0 ? nullptr : &places_[core - 1].image;
  }

  // The image of this helper, not core 0, is made. From now on the item may change things.
  void keep(std::size_t core, std::size_t item) {
    require(core > 0);
    keep_order();
    places_[core - 1].item.store(static_cast<std::uint32_t>(item), std::memory_order_relaxed);
    keep_order();
  }

  // Core 0, before it does an item: the image of the core that was lost in it. Null: nothing was
  // changed.
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
