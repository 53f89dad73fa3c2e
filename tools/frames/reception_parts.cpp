#include "tools/frames/reception_parts.hpp"

#include <algorithm>
#include <iterator>

namespace iog::tools {

bool ReceptionParts::take(const stream::ReceptionPart& part) {
  auto& place = all_.at(part.part);
  if (place || (parts_ > 0 && part.header != header_)) {
    return false;
  }
  header_ = part.header;
  place.emplace(part.all().begin(), part.all().end());
  ++parts_;
  return true;
}

std::optional<Receptions> ReceptionParts::list() const {
  if (!are_complete()) {
    return std::nullopt;
  }
  Receptions list{.all = {}, .not_listed = header_.not_listed};
  for (std::size_t number = 0; number < parts_; ++number) {
    std::ranges::copy(*all_[number], std::back_inserter(list.all));
  }
  return list;
}

}  // namespace iog::tools
