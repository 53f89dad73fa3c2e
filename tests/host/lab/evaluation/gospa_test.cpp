#include "lab/evaluation/gospa.hpp"

#include <algorithm>
#include <cstddef>
#include <gtest/gtest.h>
#include <numeric>
#include <vector>

#include "fakes/random.hpp"

namespace iog::lab {
namespace {

constexpr double kDrawnCutM = 4;

// All on one line: by their x.
Gospa on_a_line(const std::vector<double>& truth, const std::vector<double>& reported) {
  const auto points = [](const std::vector<double>& places) {
    std::vector<Vector2> all(places.size());
    std::ranges::transform(places, all.begin(), [](double x) { return Vector2{x, 0}; });
    return all;
  };
  return gospa(points(truth), points(reported), kDrawnCutM);
}

TEST(Gospa, IsNothingWithoutAnything) {
  const Gospa found = on_a_line({}, {});
  EXPECT_EQ(found.sum_m(kDrawnCutM), 0);
  EXPECT_EQ(found.missed, 0U);
  EXPECT_EQ(found.wrong, 0U);
}

// One of two is reported, 1 m off; the other one costs half the cut.
TEST(Gospa, IsPlaceAndMissedAndWrong) {
  const Gospa missed = on_a_line({0, 20}, {1});
  EXPECT_EQ(missed.place_m, 1);
  EXPECT_EQ(missed.missed, 1U);
  EXPECT_EQ(missed.wrong, 0U);
  EXPECT_EQ(missed.sum_m(kDrawnCutM), 3);
  const Gospa wrong = on_a_line({1}, {20, 0.5, -20});
  EXPECT_EQ(wrong.place_m, 0.5);
  EXPECT_EQ(wrong.missed, 0U);
  EXPECT_EQ(wrong.wrong, 2U);
  EXPECT_EQ(wrong.sum_m(kDrawnCutM), 4.5);
}

TEST(Gospa, PairsNothingThatIsAsFarApartAsTheCut) {
  const Gospa apart = on_a_line({0}, {4});
  EXPECT_EQ(apart.place_m, 0);
  EXPECT_EQ(apart.missed, 1U);
  EXPECT_EQ(apart.wrong, 1U);
  EXPECT_EQ(on_a_line({0}, {3.75}).place_m, 3.75);
}

// Whoever takes the nearest pair first, 3 with 2, has 1 m and two that are left: 5 m.
TEST(Gospa, TakesTheLeastSumAndNotTheNearestFirst) {
  const Gospa found = on_a_line({0, 3}, {2, 5});
  EXPECT_EQ(found.place_m, 4);
  EXPECT_EQ(found.missed + found.wrong, 0U);
}

TEST(Gospa, IsInThePlane) {
  const std::vector<Vector2> truth{{1, 1}};
  const std::vector<Vector2> reported{{-0.5, 3}};
  EXPECT_EQ(gospa(truth, reported, kDrawnCutM).place_m, 2.5);
}

// The same by trying all orders of the larger set.
double by_all_orders(std::span<const Vector2> few, std::span<const Vector2> many) {
  std::vector<std::size_t> order(many.size());
  std::iota(order.begin(), order.end(), 0);
  double least = 1e9;
  do {
    double sum = kDrawnCutM / 2 * static_cast<double>(many.size() - few.size());
    for (std::size_t i = 0; i < few.size(); ++i) {
      sum += std::min(distance(few[i], many[order[i]]), kDrawnCutM);
    }
    least = std::min(least, sum);
  } while (std::ranges::next_permutation(order).found);
  return least;
}

TEST(Gospa, IsTheLeastOfAllAssignments) {
  iog::tests::Random random{7};
  for (int trial = 0; trial < 300; ++trial) {
    const auto some = [&](std::size_t most) {
      std::vector<Vector2> points(random.below(most + 1));
      for (Vector2& point : points) {
        point = {random.between(0, 80) / 10.0, random.between(0, 80) / 10.0};
      }
      return points;
    };
    const std::vector<Vector2> a = some(5);
    const std::vector<Vector2> b = some(6);
    const double least = a.size() < b.size() ? by_all_orders(a, b) : by_all_orders(b, a);
    EXPECT_NEAR(gospa(a, b, kDrawnCutM).sum_m(kDrawnCutM), least, 1e-9);
  }
}

}  // namespace
}  // namespace iog::lab
