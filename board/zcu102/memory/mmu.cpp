#include "memory/mmu.hpp"

#include "require/require.hpp"

namespace iog::zcu102::mmu {
namespace {

class Builder {
 public:
  Builder(Tables& tables, std::uint64_t bus_address) : tables_(tables), bus_address_(bus_address) {
    tables_.level1.fill(kFault);
    for (Tables::Table& each : tables_.pool) {
      each.fill(kFault);
    }
  }

  // One descriptor, the largest that alignment and end allow. Returns the bytes that it maps.
  std::uint64_t map_next(std::uint64_t at, const Range& range) {
    Tables::Table& blocks = below(tables_.level1[at >> 30]);
    std::uint64_t& of_block = blocks[at / kBlockBytes % blocks.size()];
    if (of_block == kFault && at % kBlockBytes == 0 && range.end - at >= kBlockBytes) {
      of_block = block(at, range.memory);
      return kBlockBytes;
    }
    require((of_block & 0b11) != 0b01);
    Tables::Table& pages = below(of_block);
    std::uint64_t& of_page = pages[at / kPageBytes % pages.size()];
    require(of_page == kFault);
    of_page = page(at, range.memory);
    return kPageBytes;
  }

 private:
  // The table that an entry refers to; one of the pool if it does not yet.
  Tables::Table& below(std::uint64_t& entry) {
    const std::uint64_t pool =
        bus_address_ + static_cast<std::uint64_t>(reinterpret_cast<std::byte*>(&tables_.pool) -
                                                  reinterpret_cast<std::byte*>(&tables_));
    if (entry == kFault) {
      require(used_ < tables_.pool.size());
      entry = table(pool + used_++ * sizeof(Tables::Table));
    }
    return tables_.pool[((entry & ~0b11U) - pool) / sizeof(Tables::Table)];
  }

  Tables& tables_;
  std::uint64_t bus_address_;
  std::size_t used_ = 0;
};

}  // namespace

void build(Tables& tables, std::span<const Range> ranges, std::uint64_t bus_address) {
  Builder builder(tables, bus_address);
  for (const Range& range : ranges) {
    require(range.begin % kPageBytes == 0 && range.end % kPageBytes == 0);
    for (std::uint64_t at = range.begin; at != range.end;) {
      at += builder.map_next(at, range);
    }
  }
}

}  // namespace iog::zcu102::mmu
