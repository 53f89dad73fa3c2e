#include "tools/frames/object_parts.hpp"

#include <algorithm>

namespace iog::tools {

bool ObjectParts::take(const stream::ObjectPart& part) {
  if (parts_ > 0 && part.header != header_) {
    return false;
  }
  Part& place = all_.at(part.part);
  const std::size_t objects = objects_ + part.count;
  const bool is_last = parts_ + 1 == part.header.parts;
  if (place || objects > part.header.objects || (is_last && objects != part.header.objects)) {
    return false;
  }
  place = part;
  // Every other part is in order already.
  for (std::size_t other = 0; other < all_.size(); ++other) {
    const bool is_in_order =
        other == part.part ||
        (other < part.part ? is_below(all_[other], place) : is_below(place, all_[other]));
    if (!is_in_order) {
      place.reset();
      return false;
    }
  }
  header_ = part.header;
  ++parts_;
  objects_ = objects;
  return true;
}

bool ObjectParts::is_below(const Part& lower, const Part& upper) {
  return !lower || !upper || lower->all().empty() || upper->all().empty() ||
         lower->all().back().id < upper->all().front().id;
}

std::optional<stream::ObjectList> ObjectParts::list() const {
  if (!are_complete()) {
    return std::nullopt;
  }
  stream::ObjectList list{.time_us = header_.time_us,
                          .tracks_refused = header_.tracks_refused,
                          .hits_left = header_.hits_left,
                          .count = header_.objects};
  auto end = list.records.begin();
  for (std::size_t number = 0; number < parts_; ++number) {
    end = std::ranges::copy(all_[number]->all(), end).out;
  }
  return list;
}

}  // namespace iog::tools
