// The target's counters by name: where each is on the wire, and how they get there. Names are
// looked up by the compiler; an image has only those that it prints.
#pragma once

#include <algorithm>
#include <array>
#include <bit>
#include <cstddef>
#include <cstdint>
#include <iterator>
#include <optional>
#include <string_view>

#include "require/require.hpp"
#include "stream/target_table.hpp"

namespace iog::stream {

[[nodiscard]] constexpr bool is_link(const Row& row) {
  return Group::kNet <= row.group && row.group <= Group::kCommand;
}

inline constexpr std::size_t kDurationWords = 13;
[[nodiscard]] constexpr std::size_t words_of(Kind kind) {
  return kind == Kind::kDuration ? kDurationWords : kind == Kind::kMac ? 2 : 1;
}

// Of each row's first word among the link counters; the last: how many they are.
inline constexpr auto kPlaces = [] {
  std::array<std::uint8_t, std::size(table::kRows) + 1> places{};
  for (std::size_t i = 0; i < std::size(table::kRows); ++i) {
    const Row& row = table::kRows[i];
    const std::size_t end = places[i] + (is_link(row) ? words_of(row.kind) : 0);
    require(end <= 0xFF);  // a frame's end says in a byte how many there are
    places[i + 1] = static_cast<std::uint8_t>(end);
  }
  return places;
}();
static_assert(std::ranges::is_sorted(table::kRows, {}, &Row::group));

inline constexpr std::size_t kMaxLinkCounters = kPlaces.back();
using LinkCounters = std::array<std::uint32_t, kMaxLinkCounters>;

// Where a group's link counters begin.
[[nodiscard]] consteval std::size_t place_of(Group group) {
  const auto* const row = std::ranges::find(table::kRows, group, &Row::group);
  return kPlaces[static_cast<std::size_t>(row - std::begin(table::kRows))];
}

// The names of a group, in their order.
template <Group kGroup>
[[nodiscard]] consteval auto names_of() {
  constexpr auto kCount = std::ranges::count(table::kRows, kGroup, &Row::group);
  std::array<std::string_view, static_cast<std::size_t>(kCount)> names;
  auto* name = names.data();
  for (const Row& row : table::kRows) {
    if (row.group == kGroup) {
      *name++ = row.name;
    }
  }
  return names;
}

// The row of a link counter that is in the table.
[[nodiscard]] constexpr std::size_t row_of(std::string_view name) {
  std::size_t i = 0;
  while (!is_link(table::kRows[i]) || table::kRows[i].name != name) {
    ++i;
    require(i < std::size(table::kRows));
  }
  return i;
}

// Where a link counter is among them: the first of its words. A name that is not in the table does
// not compile.
[[nodiscard]] consteval std::size_t place_of(std::string_view name) {
  return kPlaces[row_of(name)];
}

// Whoever counts has a struct of 32-bit words alone whose `kNames` are their names, in the order of
// its members. The place of each word:
template <typename Counts>
[[nodiscard]] consteval auto places_of() {
  std::array<std::uint8_t, sizeof(Counts) / sizeof(std::uint32_t)> places{};
  std::size_t at = 0;
  for (const std::string_view name : Counts::kNames) {
    const std::size_t row = row_of(name);
    for (std::size_t word = kPlaces[row]; word < kPlaces[row + 1]; ++word) {
      places.at(at++) = static_cast<std::uint8_t>(word);
    }
  }
  require(at == places.size());
  return places;
}

// Whether every link counter is counted by somebody, and by nobody else.
template <typename... Counts>
[[nodiscard]] consteval bool is_each_counted_once() {
  std::array<std::uint8_t, kMaxLinkCounters> times{};
  const auto count = [&](const auto& places) {
    for (const std::uint8_t place : places) {
      ++times.at(place);
    }
  };
  (count(places_of<Counts>()), ...);
  return std::ranges::count(times, 1) == kMaxLinkCounters;
}

template <typename Counts>
void put(const Counts& counts, LinkCounters& counters) {
  static constexpr auto kTheirs = places_of<Counts>();
  const auto words = std::bit_cast<std::array<std::uint32_t, kTheirs.size()>>(counts);
  for (std::size_t i = 0; i < words.size(); ++i) {
    counters[kTheirs[i]] = words[i];
  }
}

// What `counts` has of counters, of which the target has sent the first so many. Empty: not all.
template <typename Counts>
[[nodiscard]] std::optional<Counts> get(const LinkCounters& counters, std::size_t sent) {
  static constexpr auto kTheirs = places_of<Counts>();
  if (sent <= std::ranges::max(kTheirs)) {
    return std::nullopt;
  }
  std::array<std::uint32_t, kTheirs.size()> words{};
  std::ranges::transform(kTheirs, words.begin(), [&](std::size_t at) { return counters[at]; });
  return std::bit_cast<Counts>(words);
}

template <typename... Counts>
void put_all(LinkCounters& counters, const Counts&... counts) {
  static_assert(is_each_counted_once<Counts...>());
  (put(counts, counters), ...);
}

inline constexpr auto kLosses = [] {
  constexpr auto kCount = std::ranges::count(table::kRows, Kind::kLoss, &Row::kind);
  std::array<std::uint8_t, static_cast<std::size_t>(kCount)> losses{};
  auto* loss = losses.data();
  for (const Row& row : table::kRows) {
    if (row.kind == Kind::kLoss) {
      *loss++ = kPlaces[row_of(row.name)];
    }
  }
  return losses;
}();

// How many datagrams the link has lost, modulo 2^32.
[[nodiscard]] constexpr std::uint32_t losses_of(const LinkCounters& counters) {
  std::uint32_t sum = 0;
  for (const std::uint8_t loss : kLosses) {
    sum += counters[loss];
  }
  return sum;
}

}  // namespace iog::stream
