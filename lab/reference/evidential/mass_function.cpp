#include "lab/reference/evidential/mass_function.hpp"

#include <bit>
#include <functional>
#include <numeric>

namespace iog::lab::reference::evidential {
namespace {

template <typename Join>
MassFunction joined(const MassFunction& one, const MassFunction& other, const Join& join) {
  MassFunction fused = MassFunction::empty(one.elements());
  const Focals of_other(other);
  for (const Set b : Focals(one)) {
    for (const Set c : of_other) {
      fused[join(b, c)] += one[b] * other[c];
    }
  }
  return fused;
}

}  // namespace

MassFunction::MassFunction(int elements, std::initializer_list<Focal> focals)
    : elements_(elements) {
  for (const Focal& focal : focals) {
    masses_[focal.set] = focal.mass;
  }
  masses_[frame()] += 1 - total();
}

MassFunction MassFunction::empty(int elements) {
  MassFunction none(elements);
  none[none.frame()] = 0;
  return none;
}

double MassFunction::total() const { return std::accumulate(masses_.begin(), masses_.end(), 0.0); }

int cardinality(Set set) { return std::popcount(set); }

MassFunction conjunctive(const MassFunction& one, const MassFunction& other) {
  return joined(one, other, std::bit_and());
}

MassFunction disjunctive(const MassFunction& one, const MassFunction& other) {
  return joined(one, other, std::bit_or());
}

MassFunction normalised(const MassFunction& subnormal) {
  MassFunction normal = MassFunction::empty(subnormal.elements());
  for (const Set a : Focals(subnormal)) {
    normal[a] = a == 0 ? 0 : subnormal[a] / (1 - subnormal[0]);
  }
  return normal;
}

MassFunction dempster(const MassFunction& one, const MassFunction& other) {
  return normalised(conjunctive(one, other));
}

MassFunction yager(const MassFunction& one, const MassFunction& other) {
  MassFunction fused = conjunctive(one, other);
  fused[fused.frame()] += fused[0];
  fused[0] = 0;
  return fused;
}

Set refined(Set coarse, std::span<const Set> images) {
  Set fine = 0;
  for (std::size_t element = 0; element < images.size(); ++element) {
    if ((coarse >> element & 1) != 0) {
      fine |= images[element];
    }
  }
  return fine;
}

// Two coarse sets may have the same image, as with the map's classes, whose images overlap.
MassFunction refined(const MassFunction& coarse, std::span<const Set> images, int elements) {
  MassFunction fine = MassFunction::empty(elements);
  for (Set a = 0; a <= coarse.frame(); ++a) {
    fine[refined(a, images)] += coarse[a];
  }
  return fine;
}

double pignistic(const MassFunction& mass, Set set) {
  double probability = 0;
  for (const Set a : Focals(mass)) {
    probability += a == 0 ? 0 : mass[a] * cardinality(set & a) / cardinality(a);
  }
  return probability;
}

}  // namespace iog::lab::reference::evidential
