// What a target has received in a frame, out of its messages: all of it, or nothing.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <vector>

#include "stream/receptions.hpp"

namespace iog::tools {

struct Receptions {
  std::vector<stream::Reception> all;  // in the order in which they came
  std::uint32_t not_listed = 0;        // that came behind the last of them
};

class ReceptionParts {
 public:
  // A part that stream::read_receptions() has found sound, in any order. False, and of no use, if
  // it contradicts those before, or has come already.
  [[nodiscard]] bool take(const stream::ReceptionPart& part);

  // Whether the whole list has come.
  [[nodiscard]] bool are_complete() const { return parts_ > 0 && parts_ == header_.parts; }

  // Nothing if a part is missing.
  [[nodiscard]] std::optional<Receptions> list() const;

 private:
  stream::ReceptionsHeader header_{};  // of any of them
  std::size_t parts_ = 0;              // that have come
  std::array<std::optional<std::vector<stream::Reception>>, stream::kMaxReceptionParts> all_{};
};

}  // namespace iog::tools
