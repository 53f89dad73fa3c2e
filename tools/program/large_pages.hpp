// Places for objects of tens of megabytes, such as the pipeline of a car. In large pages, their
// first use costs a page fault per 2 MiB instead of one per 4 KiB.
#pragma once

#include <cstddef>
#include <cstdlib>
#include <memory>
#include <new>
#include <sys/mman.h>
#include <utility>

namespace iog::tools {

template <typename T>
struct DeleteLarge {
  void operator()(T* object) const {
    object->~T();
    std::free(object);
  }
};
template <typename T>
using Large = std::unique_ptr<T, DeleteLarge<T>>;

// Constructs a T from the arguments. std::bad_alloc if there is no memory.
template <typename T, typename... Args>
[[nodiscard]] Large<T> make_large(Args&&... args) {
  constexpr std::size_t kPage = std::size_t{2} << 20;
  constexpr std::size_t kBytes = (sizeof(T) + kPage - 1) / kPage * kPage;
  struct Free {
    void operator()(void* place) const { std::free(place); }
  };
  std::unique_ptr<void, Free> place(std::aligned_alloc(kPage, kBytes));
  if (place == nullptr) {
    throw std::bad_alloc();
  }
  madvise(place.get(), kBytes, MADV_HUGEPAGE);  // if refused, small pages are used
  Large<T> made(new (place.get()) T(std::forward<Args>(args)...));
  static_cast<void>(place.release());
  return made;
}

}  // namespace iog::tools
