#include "lab/reference/evidential/focal_sets.hpp"

namespace iog::lab::reference::evidential {
namespace {

MassFunction evenly_on(const FocalSets& sets, int elements) {
  MassFunction mass = MassFunction::empty(elements);
  for (Set a = 0; a <= mass.frame(); ++a) {
    mass[a] = sets[a] ? 1 / static_cast<double>(sets.count()) : 0;
  }
  return mass;
}

}  // namespace

FocalSets focal_sets(const MassFunction& mass) {
  FocalSets sets;
  for (Set a = 0; a <= mass.frame(); ++a) {
    sets[a] = mass[a] > 0;
  }
  return sets;
}

FocalSets closure(int elements, std::span<const Operation> operations) {
  FocalSets reached = focal_sets(MassFunction(elements));
  for (FocalSets before; before != reached;) {
    before = reached;
    for (const Operation& operation : operations) {
      reached |= focal_sets(operation(evenly_on(before, elements)));
    }
  }
  return reached;
}

}  // namespace iog::lab::reference::evidential
