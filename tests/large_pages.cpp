// The heap of AddressSanitizer asks the kernel for each large object anew, and each first use of 4
// KiB is a page fault, which takes half of a test that makes many grids. Here the kernel gives them
// at once.
#include <cstddef>
#include <memory>
#include <sanitizer/allocator_interface.h>
#include <sys/mman.h>

// Called by the heap for each allocation. If the kernel refuses, there are page faults.
void __sanitizer_malloc_hook(const volatile void* ptr, size_t size) {
  constexpr std::size_t kPage = std::size_t{4} << 10;
  constexpr std::size_t kLargePage = std::size_t{2} << 20;
  constexpr std::size_t kLarge = std::size_t{128} << 10;
  void* place = const_cast<void*>(ptr);
  if (size < kLarge || std::align(kPage, kLarge - kPage, place, size) == nullptr) {
    return;
  }
  void* large = place;
  std::size_t large_size = size;
  if (std::align(kLargePage, kLargePage, large, large_size) != nullptr) {
    madvise(large, large_size / kLargePage * kLargePage, MADV_HUGEPAGE);
  }
  madvise(place, size / kPage * kPage, MADV_POPULATE_WRITE);
}
