#include "tlb.hpp"

#include <algorithm>
#include <bit>
#include <utility>

namespace iog::a9_model {
namespace {

constexpr std::uint32_t kNoPage = 0xffff'ffff;

}  // namespace

bool MainTlb::find_or_insert(std::uint32_t page) {
  auto& set = pages_[page % kSets];
  if (set[0] == page + 1) {
    return true;
  }
  const bool found = set[1] == page + 1;
  set[1] = std::exchange(set[0], page + 1);
  return found;
}

MicroTlb::MicroTlb(const Constants& constants, MainTlb& main, TlbCounts& counts)
    : main_(main),
      counts_(counts),
      page_shift_(10 + static_cast<std::uint32_t>(std::countr_zero(constants.page_kb))),
      main_extra_(constants.main_tlb_extra),
      walk_extra_(constants.walk_extra),
      recent_(kNoPage),
      entries_(constants.micro_tlb, Entry{.page = kNoPage, .used = 0}) {}

std::uint32_t MicroTlb::look_up(std::uint32_t page) {
  recent_ = page;
  const auto found = std::ranges::find(entries_, page, &Entry::page);
  if (found != entries_.end()) {
    found->used = ++clock_;
    return 0;
  }
  ++counts_.micro_misses;
  *std::ranges::min_element(entries_, {}, &Entry::used) = {.page = page, .used = ++clock_};
  if (main_.find_or_insert(page)) {
    return main_extra_;
  }
  ++counts_.walks;
  return main_extra_ + walk_extra_;
}

}  // namespace iog::a9_model
