// memcpy() and its like against loops over bytes: every length up to a few blocks, every alignment
// of both sides, every overlap; and nothing outside is touched. Says one line, then lets the
// watchdog end the run.
#include <array>
#include <cstddef>
#include <cstring>

#include "board.hpp"

namespace {

constexpr std::size_t kLengths = 150;
constexpr std::size_t kAlignments = 17;
constexpr std::size_t kBytes = kLengths + 2 * kAlignments + 64;
using Bytes = std::array<unsigned char, kBytes>;

Bytes numbered() {
  Bytes bytes{};
  for (std::size_t index = 0; index < kBytes; ++index) {
    bytes[index] = static_cast<unsigned char>(index * 7 + 3);
  }
  return bytes;
}

// Both move `length` bytes from `from` to `to` in one array; the first is the law.
Bytes moved_by_hand(Bytes bytes, std::size_t to, std::size_t from, std::size_t length) {
  const Bytes before = bytes;
  for (std::size_t index = 0; index < length; ++index) {
    bytes[to + index] = before[from + index];
  }
  return bytes;
}

bool moves(std::size_t to, std::size_t from, std::size_t length) {
  const Bytes before = numbered();
  const Bytes expected = moved_by_hand(before, to, from, length);
  Bytes overlapping = before;
  std::memmove(&overlapping[to], &overlapping[from], length);
  Bytes apart = before;
  std::memcpy(&apart[to], &before[from], length);
  for (std::size_t index = 0; index < kBytes; ++index) {
    if (overlapping[index] != expected[index] || apart[index] != expected[index]) {
      return false;
    }
  }
  return true;
}

bool sets(std::size_t to, std::size_t length) {
  const Bytes before = numbered();
  Bytes after = before;
  std::memset(&after[to], 0xa5, length);
  for (std::size_t index = 0; index < kBytes; ++index) {
    const bool inside = index >= to && index < to + length;
    if (after[index] != (inside ? 0xa5 : before[index])) {
      return false;
    }
  }
  return true;
}

bool compares(std::size_t length) {
  const Bytes left = numbered();
  Bytes right = left;
  if (std::memcmp(left.data(), right.data(), length) != 0) {
    return false;
  }
  right[length] ^= 0x80;  // just behind: not looked at
  const bool blind = std::memcmp(left.data(), right.data(), length) == 0;
  const int first = left[length] < right[length] ? -1 : 1;
  const int found = std::memcmp(left.data(), right.data(), length + 1);
  return blind && (found < 0) == (first < 0) && found != 0;
}

bool all_right(iog::imx6::Watchdog& watchdog) {
  bool right = true;
  for (std::size_t length = 0; length < kLengths; ++length) {
    for (std::size_t to = 0; to < kAlignments; ++to) {
      for (std::size_t from = 0; from < kAlignments; ++from) {
        right = right && moves(to, from, length);
      }
      right = right && sets(to, length);
    }
    right = right && compares(length);
    watchdog.service();
  }
  return right && std::strlen("four") == 4 && std::strlen("") == 0;
}

}  // namespace

int main() {
  iog::imx6::Board board({0x02, 0, 0, 0, 0, 1});
  const bool right = all_right(board.watchdog());
  board.console().write(right ? "memory functions right\n" : "memory functions wrong\n");
  for (;;) {
    board.idle();
  }
}
