// What is asked of the perception grid, whoever keeps it: a reference, as work::Crew is.
#pragma once

#include <concepts>

#include "geometry/cell.hpp"
#include "objects/name.hpp"

namespace iog::objects {

// name_of: what a cell of the local frame is called after the frame; kUnknown outside of the
// window. is_open: whether the ground there was known to be open when the frame began.
template <typename T>
concept Namer = requires(const T& its, geometry::Cell cell) {
  { its.name_of(cell) } -> std::same_as<Name>;
  { its.is_open(cell) } -> std::same_as<bool>;
};

class GridNames {
 public:
  // namer outlives this.
  template <Namer T>
  explicit GridNames(const T& namer)
      : its_(&namer),
        name_of_([](const void* its, geometry::Cell cell) {
          return static_cast<const T*>(its)->name_of(cell);
        }),
        is_open_([](const void* its, geometry::Cell cell) {
          return static_cast<const T*>(its)->is_open(cell);
        }) {}

  [[nodiscard]] Name name_of(geometry::Cell cell) const { return name_of_(its_, cell); }
  [[nodiscard]] bool is_open(geometry::Cell cell) const { return is_open_(its_, cell); }

  // Whether one of the nine cells around a cell, itself included, has a name that is asked for.
  template <typename IsAsked>
  [[nodiscard]] bool is_any_near(geometry::Cell cell, IsAsked&& is_asked) const {
    for (std::int32_t y = cell.y - 1; y <= cell.y + 1; ++y) {
      for (std::int32_t x = cell.x - 1; x <= cell.x + 1; ++x) {
        if (is_asked(name_of(geometry::Cell{x, y}))) {
          return true;
        }
      }
    }
    return false;
  }

 private:
  const void* its_;
  Name (*name_of_)(const void*, geometry::Cell);
  bool (*is_open_)(const void*, geometry::Cell);
};

}  // namespace iog::objects
