// The tracker's interface to the perception grid. GridNames is a non-owning, type-erased reference
// to any type that provides the class labels of cells.
#pragma once

#include <concepts>

#include "geometry/cell.hpp"
#include "objects/name.hpp"

namespace iog::objects {

struct CellName {
  Name name = Name::kUnknown;  // after the frame; kUnknown outside the window
  bool is_open = false;        // the ground was known to be open at the start of the frame
};

// `look_at()` returns the class label of one cell of the local frame. `names_around()` returns the
// class labels of a cell and its eight neighbours.
template <typename T>
concept Namer = requires(const T& its, geometry::Cell cell) {
  { its.look_at(cell) } -> std::same_as<CellName>;
  { its.names_around(cell) } -> std::same_as<Names>;
};

class GridNames {
 public:
  // `namer` must outlive this object.
  template <Namer T>
  explicit GridNames(const T& namer)
      : its_(&namer),
        look_at_([](const void* its, geometry::Cell cell) {
          return static_cast<const T*>(its)->look_at(cell);
        }),
        names_around_([](const void* its, geometry::Cell cell) {
          return static_cast<const T*>(its)->names_around(cell);
        }) {}

  [[nodiscard]] CellName look_at(geometry::Cell cell) const { return look_at_(its_, cell); }
  [[nodiscard]] Names names_around(geometry::Cell cell) const { return names_around_(its_, cell); }

 private:
  const void* its_;
  CellName (*look_at_)(const void*, geometry::Cell);
  Names (*names_around_)(const void*, geometry::Cell);
};

}  // namespace iog::objects
