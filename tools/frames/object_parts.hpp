// The list of a frame's objects, out of its messages: all of it, or nothing.
#pragma once

#include <array>
#include <cstddef>
#include <optional>

#include "stream/objects.hpp"

namespace iog::tools {

class ObjectParts {
 public:
  // A part that stream::read_objects() has found sound, in any order. False, and of no use, if it
  // contradicts those before: it says otherwise of the list, has come already, or has ids that are
  // not between those of its neighbours.
  [[nodiscard]] bool take(const stream::ObjectPart& part);

  // Whether the whole list has come.
  [[nodiscard]] bool are_complete() const { return parts_ > 0 && parts_ == header_.parts; }

  // Nothing if a part is missing.
  [[nodiscard]] std::optional<stream::ObjectList> list() const;

 private:
  using Part = std::optional<stream::ObjectPart>;

  // Whether all ids of one are below all of the other. Parts that have not come do not matter.
  [[nodiscard]] static bool is_below(const Part& lower, const Part& upper);

  stream::ObjectsHeader header_{};  // of any of them
  std::size_t parts_ = 0;           // that have come
  std::size_t objects_ = 0;         // in these
  std::array<Part, stream::kMaxObjectParts> all_{};
};

}  // namespace iog::tools
