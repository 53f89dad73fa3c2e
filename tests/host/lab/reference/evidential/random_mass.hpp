// Mass functions for tests.
#pragma once

#include "fakes/random.hpp"
#include "lab/reference/evidential/mass_function.hpp"

namespace iog::tests {

// 0 ... 1
inline double random_share(Random& random) { return random.between(0, 1 << 30) / 0x1p30; }

// Normal, and with something on about half of all sets.
inline lab::reference::evidential::MassFunction random_mass(Random& random, int elements) {
  auto mass = lab::reference::evidential::MassFunction::empty(elements);
  for (lab::reference::evidential::Set set = 1; set <= mass.frame(); ++set) {
    mass[set] = random.one_in(2) ? random_share(random) : 0;
  }
  mass[mass.frame()] += 0.01;
  const double total = mass.total();
  for (lab::reference::evidential::Set set = 1; set <= mass.frame(); ++set) {
    mass[set] /= total;
  }
  return mass;
}

// The largest difference between the masses of a set.
inline double largest_difference(const lab::reference::evidential::MassFunction& one,
                                 const lab::reference::evidential::MassFunction& other) {
  double largest = 0;
  for (lab::reference::evidential::Set set = 0; set <= one.frame(); ++set) {
    const double difference = one[set] - other[set];
    largest = difference > largest ? difference : -difference > largest ? -difference : largest;
  }
  return largest;
}

}  // namespace iog::tests
