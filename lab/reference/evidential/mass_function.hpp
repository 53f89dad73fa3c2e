// Mass functions (basic belief assignments) over all subsets of a small frame of discernment, and
// the rules that combine two of them (Kurdej 2015, sections 3.4 and 3.5). Every sum is as printed.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <initializer_list>
#include <span>

namespace iog::lab::reference::evidential {

// A subset of the frame: bit i says whether its element i is in it. 0 is the empty set.
using Set = std::uint32_t;

class MassFunction {
 public:
  static constexpr int kMostElements = 6;

  struct Focal {
    Set set = 0;
    double mass = 0;
  };

  // The masses that are given; the frame has what they leave of 1. Without any it is the vacuous
  // mass function of definition 15. 1 ... kMostElements elements; no set twice.
  explicit MassFunction(int elements, std::initializer_list<Focal> focals = {});

  // Of no mass at all, to be filled.
  [[nodiscard]] static MassFunction empty(int elements);

  [[nodiscard]] int elements() const { return elements_; }
  [[nodiscard]] Set frame() const { return (Set{1} << elements_) - 1; }

  [[nodiscard]] double operator[](Set set) const { return masses_[set]; }
  double& operator[](Set set) { return masses_[set]; }

  // Of all sets, the empty one included; 1, unless a printed formula went wrong.
  [[nodiscard]] double total() const;
  // Of all sets but the frame: 1 less this is the frame's.
  [[nodiscard]] double committed() const { return total() - masses_[frame()]; }

 private:
  int elements_;
  std::array<double, std::size_t{1} << kMostElements> masses_{};
};

// The sets that have mass: of 64 they are few.
class Focals {
 public:
  explicit Focals(const MassFunction& mass) {
    for (Set a = 0; a <= mass.frame(); ++a) {
      sets_[count_] = a;
      count_ += mass[a] != 0 ? 1U : 0U;
    }
  }
  [[nodiscard]] const Set* begin() const { return sets_.data(); }
  [[nodiscard]] const Set* end() const { return sets_.data() + count_; }

 private:
  std::array<Set, (std::size_t{1} << MassFunction::kMostElements) + 1> sets_;
  std::size_t count_ = 0;
};

[[nodiscard]] int cardinality(Set set);
[[nodiscard]] inline bool is_subset(Set set, Set of) { return (set & ~of) == 0; }

// Both of the same frame, for all rules.
[[nodiscard]] MassFunction conjunctive(const MassFunction& one, const MassFunction& other);  // 3.41
[[nodiscard]] MassFunction disjunctive(const MassFunction& one, const MassFunction& other);  // 3.43
// Dempster's normalisation (equations 3.18 to 3.20). The empty set must have less than 1.
[[nodiscard]] MassFunction normalised(const MassFunction& subnormal);
// Dempster's rule: conjunctive and normalised.
[[nodiscard]] MassFunction dempster(const MassFunction& one, const MassFunction& other);
// Yager's rule: conjunctive, and conflict is ignorance (equation 3.45).
[[nodiscard]] MassFunction yager(const MassFunction& one, const MassFunction& other);

// The same knowledge in a finer frame (equations 3.26 and 3.27). images: what each element of the
// coarse frame becomes; that of a union is the union of the images.
[[nodiscard]] Set refined(Set coarse, std::span<const Set> images);
[[nodiscard]] MassFunction refined(const MassFunction& coarse, std::span<const Set> images,
                                   int elements);

// betP(set) (equation 3.40) of a normal mass function.
[[nodiscard]] double pignistic(const MassFunction& mass, Set set);

}  // namespace iog::lab::reference::evidential
