// Looks up the target's counters by name and returns their positions on the wire. Names are
// resolved at compile time, so an image contains only the names that it prints.
#pragma once

#include <algorithm>
#include <array>
#include <bit>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <string_view>

#include "require/require.hpp"
#include "stream/target_table.hpp"

namespace iog::stream {

struct Counter {
  Group group{};
  Kind kind{};
  std::string_view name;
};

[[nodiscard]] constexpr bool is_link(const Counter& counter) {
  return Group::kNet <= counter.group && counter.group <= Group::kCommand;
}

// Lists all counters in the table, in table order.
inline constexpr auto kCounters = [] {
  constexpr std::string_view kBetween = ", ";
  constexpr std::size_t kCount = [=] {
    std::size_t count = 0;
    for (const Row& row : table::kRows) {
      count += 1 + static_cast<std::size_t>(std::ranges::count(row.names, kBetween.front()));
    }
    return count;
  }();
  std::array<Counter, kCount> counters{};
  auto* counter = counters.data();
  for (const Row& row : table::kRows) {
    std::size_t begin = 0;
    for (std::size_t end = 0; end != row.names.size(); begin = end + kBetween.size()) {
      end = std::min(row.names.find(kBetween, begin), row.names.size());
      *counter++ = {row.group, row.kind, row.names.substr(begin, end - begin)};
    }
  }
  return counters;
}();
inline constexpr std::size_t kCounterCount = kCounters.size();
static_assert(std::ranges::is_sorted(kCounters, {}, &Counter::group));

inline constexpr std::size_t kDurationWords = 13;
[[nodiscard]] constexpr std::size_t words_of(Kind kind) {
  return kind == Kind::kDuration ? kDurationWords
         : kind == Kind::kRoom   ? kSpareWords
         : kind == Kind::kMac    ? 2
                                 : 1;
}

// For each counter, the index of its first word in LinkCounters. The last entry is the total number
// of words.
inline constexpr auto kPlaces = [] {
  std::array<std::uint8_t, kCounterCount + 1> places{};
  for (std::size_t i = 0; i < kCounterCount; ++i) {
    const Counter& counter = kCounters[i];
    const std::size_t end = places[i] + (is_link(counter) ? words_of(counter.kind) : 0);
    require(end <= 0xFF);  // the frame end stores this number in one byte
    places[i + 1] = static_cast<std::uint8_t>(end);
  }
  return places;
}();

inline constexpr std::size_t kMaxLinkCounters = kPlaces.back();
using LinkCounters = std::array<std::uint32_t, kMaxLinkCounters>;

// Returns the index of the first link counter of a group.
[[nodiscard]] consteval std::size_t place_of(Group group) {
  const auto* const counter = std::ranges::find(kCounters, group, &Counter::group);
  return kPlaces[static_cast<std::size_t>(counter - kCounters.begin())];
}

// Returns the names of a group's counters, in order.
template <Group kGroup>
[[nodiscard]] consteval auto names_of() {
  constexpr auto kCount = std::ranges::count(kCounters, kGroup, &Counter::group);
  std::array<std::string_view, static_cast<std::size_t>(kCount)> names;
  auto* name = names.data();
  for (const Counter& counter : kCounters) {
    if (counter.group == kGroup) {
      *name++ = counter.name;
    }
  }
  return names;
}

// Returns the table index of a link counter.
[[nodiscard]] constexpr std::size_t number_of(std::string_view name) {
  std::size_t i = 0;
  while (!is_link(kCounters[i]) || kCounters[i].name != name) {
    ++i;
    require(i < kCounters.size());
  }
  return i;
}

// Returns the index of a link counter's first word in LinkCounters. The code does not compile if
// the name is not in the table.
[[nodiscard]] consteval std::size_t place_of(std::string_view name) {
  return kPlaces[number_of(name)];
}

// Returns the index in LinkCounters of each word of `Counts`. `Counts` is a struct that contains
// only 32-bit words, and `Counts::kNames` lists the names of its members in order.
template <typename Counts>
[[nodiscard]] consteval auto places_of() {
  std::array<std::uint8_t, sizeof(Counts) / sizeof(std::uint32_t)> places{};
  std::size_t at = 0;
  for (const std::string_view name : Counts::kNames) {
    const std::size_t number = number_of(name);
    for (std::size_t word = kPlaces[number]; word < kPlaces[number + 1]; ++word) {
      places.at(at++) = static_cast<std::uint8_t>(word);
    }
  }
  require(at == places.size());
  return places;
}

// Returns true if every link counter except the spare words belongs to exactly one of the structs
// `Counts`, and the spare words belong to none of them.
template <typename... Counts>
[[nodiscard]] consteval bool is_each_counted_once() {
  std::array<std::uint8_t, kMaxLinkCounters> times{};
  const auto count = [&](const auto& places) {
    for (const std::uint8_t place : places) {
      ++times.at(place);
    }
  };
  (count(places_of<Counts>()), ...);
  return std::ranges::count(times, 1) == kMaxLinkCounters - kSpareWords;
}

template <typename Counts>
void put(const Counts& counts, LinkCounters& counters) {
  static constexpr auto kTheirs = places_of<Counts>();
  const auto words = std::bit_cast<std::array<std::uint32_t, kTheirs.size()>>(counts);
  for (std::size_t i = 0; i < words.size(); ++i) {
    counters[kTheirs[i]] = words[i];
  }
}

// Reads the counters in `Counts`. Returns std::nullopt if any of them is not among the first `sent`
// words.
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
  constexpr auto kCount = std::ranges::count(kCounters, Kind::kLoss, &Counter::kind);
  std::array<std::uint8_t, static_cast<std::size_t>(kCount)> losses{};
  auto* loss = losses.data();
  for (const Counter& counter : kCounters) {
    if (counter.kind == Kind::kLoss) {
      *loss++ = kPlaces[number_of(counter.name)];
    }
  }
  return losses;
}();

// Returns the number of datagrams lost on the link, modulo 2^32.
[[nodiscard]] constexpr std::uint32_t losses_of(const LinkCounters& counters) {
  std::uint32_t sum = 0;
  for (const std::uint8_t loss : kLosses) {
    sum += counters[loss];
  }
  return sum;
}

}  // namespace iog::stream
