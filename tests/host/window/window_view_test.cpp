// What is said of the cells around one is what is said of each of them.
#include "window/window_view.hpp"

#include <gtest/gtest.h>
#include <memory>

#include "fakes/random.hpp"

namespace iog::window {
namespace {

using geometry::Cell;

constexpr Cell kVehicle{7'000, -3'000};

// Random bytes of classes in most of its tiles; the others are unknown.
std::unique_ptr<Window> random_window(tests::Random& random) {
  auto window = std::make_unique<Window>();
  window->follow(kVehicle);
  for (std::size_t slot = 0; slot < kSlotCount; ++slot) {
    if (!random.one_in(5)) {
      for (decision::Decided& group : window->open(slot).decided) {
        for (std::int8_t& byte : group) {
          byte = static_cast<std::int8_t>(random.between(0, 71));
        }
      }
    }
  }
  return window;
}

std::uint32_t classes_of_nine(const WindowView& view, Cell cell) {
  std::uint32_t classes = 0;
  for (std::int32_t y = cell.y - 1; y <= cell.y + 1; ++y) {
    for (std::int32_t x = cell.x - 1; x <= cell.x + 1; ++x) {
      classes |= 1U << static_cast<unsigned>(decision::class_of(view.name_of({x, y})));
    }
  }
  return classes;
}

TEST(WindowView, ClassesAroundACellAreThoseOfNine) {
  tests::Random random(21);
  const auto window = random_window(random);
  const Refreshed refreshed{};
  const ageing::Clock clock;
  const WindowView view(*window, refreshed, clock);
  for (int i = 0; i < 4'000; ++i) {
    // A tile's borders, and places outside of the window, among them.
    const Cell cell{kVehicle.x + random.between(-530, 530), kVehicle.y + random.between(-530, 530)};
    ASSERT_EQ(view.classes_around(cell), classes_of_nine(view, cell)) << cell.x << ", " << cell.y;
  }
}

// Bit x of row y, of tiles that are known and in the window.
TEST(WindowView, GroundIsOpenWhereItIsRemembered) {
  const auto window = std::make_unique<Window>();
  window->follow({0, 0});
  const Refreshed refreshed{};
  const ageing::Clock clock;
  const WindowView view(*window, refreshed, clock);
  window->open(slot_of({2, -3})).ground.open[7] = 1U << 30;
  EXPECT_TRUE(view.is_open({2 * 32 + 30, -3 * 32 + 7}));
  EXPECT_FALSE(view.is_open({2 * 32 + 29, -3 * 32 + 7}));
  EXPECT_FALSE(view.is_open({2 * 32 + 30, -3 * 32 + 8}));
  EXPECT_FALSE(view.is_open({3 * 32 + 30, -3 * 32 + 7})) << "not known";
  EXPECT_FALSE(view.is_open({2 * 32 + 30 + kCellsAcross, -3 * 32 + 7})) << "the same slot, outside";
}

}  // namespace
}  // namespace iog::window
