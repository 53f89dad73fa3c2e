// A solid during a short interval, in which it moves straight and turns evenly.
#pragma once

#include <cmath>

#include "tools/simulate/world/solid.hpp"

namespace iog::tools {

// Slower things are taken to stand.
inline constexpr double kStandingMps = 0.05;

struct MovingSolid {
  Solid begin;    // where it is at the interval's begin
  Placement end;  // and at its end
  Footing end_footing{};

  // Metres that its centre goes.
  [[nodiscard]] double way() const {
    const double dx = end.x - begin.at.x;
    const double dy = end.y - begin.at.y;
    return std::sqrt(dx * dx + dy * dy);
  }
  [[nodiscard]] bool moves() const {
    return end.x != begin.at.x || end.y != begin.at.y || end.cos != begin.at.cos ||
           end.sin != begin.at.sin;
  }

  // share: of the interval, 0 ... 1.
  [[nodiscard]] Solid at(double share) const {
    if (!moves()) {
      return begin;
    }
    const double cos = begin.at.cos + share * (end.cos - begin.at.cos);
    const double sin = begin.at.sin + share * (end.sin - begin.at.sin);
    const double norm = std::sqrt(cos * cos + sin * sin);
    const auto between = [share](double from, double to) { return from + share * (to - from); };
    Solid solid = begin;
    solid.footing = {.z = between(begin.footing.z, end_footing.z),
                     .along = between(begin.footing.along, end_footing.along),
                     .left = between(begin.footing.left, end_footing.left)};
    solid.at = {.x = begin.at.x + share * (end.x - begin.at.x),
                .y = begin.at.y + share * (end.y - begin.at.y),
                .cos = cos / norm,
                .sin = sin / norm};
    return solid;
  }
};

}  // namespace iog::tools
