#include "lab/reference/evidential/discounting.hpp"

namespace iog::lab::reference::evidential {
namespace {

// How much of theta's rate hits a set: all of it, nothing, or the share that lies in theta. The
// empty set is hit by every rate.
double weight(Set set, Set theta, Scheme scheme) {
  if (set == 0) {
    return 1;
  }
  switch (scheme) {
    case Scheme::kConservative:
      return (set & theta) != 0 ? 1 : 0;
    case Scheme::kOptimistic:
      return is_subset(set, theta) ? 1 : 0;
    case Scheme::kProportional:
      break;
  }
  return static_cast<double>(cardinality(set & theta)) / cardinality(set);
}

// The products of equations 6.20 to 6.31: over the rates that hit a set, with the kept or with the
// lost shares; equations 6.30 and 6.31 multiply either by the share that lies in theta.
double printed_product(Set set, Scheme scheme, Rates rates, bool of_losses) {
  double product = 1;
  for (const Rate& rate : rates) {
    const double hit = weight(set, rate.theta, scheme);
    if (hit > 0) {
      product *= (of_losses ? rate.alpha : 1 - rate.alpha) * hit;
    }
  }
  return product;
}

}  // namespace

MassFunction discounted_classically(const MassFunction& mass, double alpha) {
  MassFunction less = mass;
  for (Set a = 0; a <= mass.frame(); ++a) {
    less[a] *= 1 - alpha;
  }
  less[mass.frame()] += alpha;
  return less;
}

MassFunction contextual_mass(int elements, Rates rates) {
  MassFunction product(elements, {{0, 1}});
  for (const Rate& rate : rates) {
    product = disjunctive(product,
                          MassFunction(elements, {{0, 1 - rate.alpha}, {rate.theta, rate.alpha}}));
  }
  return product;
}

MassFunction discounted_contextually(const MassFunction& mass, Rates rates) {
  return disjunctive(mass, contextual_mass(mass.elements(), rates));
}

MassFunction discounted(const MassFunction& mass, Scheme scheme, Rates rates) {
  MassFunction less = mass;
  for (const Set a : Focals(mass)) {
    for (const Rate& rate : rates) {
      less[a] *= 1 - rate.alpha * weight(a, rate.theta, scheme);
    }
  }
  less[mass.frame()] = 1 - less.committed();
  return less;
}

// The sums over all sets but the frame in equations 6.22, 6.25 and 6.31 are taken without the empty
// set, which has a term of its own there.
MassFunction discounted_as_printed(const MassFunction& mass, Scheme scheme, Rates rates) {
  MassFunction less = mass;
  double lost = 0;
  for (Set a = 0; a <= mass.frame(); ++a) {
    less[a] *= printed_product(a, scheme, rates, false);
    if (a != mass.frame()) {
      lost += mass[a] * printed_product(a, scheme, rates, true);
    }
  }
  less[mass.frame()] += lost;
  return less;
}

}  // namespace iog::lab::reference::evidential
