#include "tools/program/progress.hpp"

#include <algorithm>
#include <cmath>
#include <iostream>
#include <unistd.h>
#include <utility>

namespace iog::tools {
namespace {

constexpr std::chrono::milliseconds kNotYet{500};
constexpr std::chrono::milliseconds kEvery{200};

// "1:02:03", "2:03", "0:03"
std::string words_of_time(double seconds) {
  const auto whole = static_cast<std::uint64_t>(std::ceil(seconds));
  const auto two_digits = [](std::uint64_t number) {
    return (number < 10 ? "0" : "") + std::to_string(number);
  };
  const std::uint64_t hours = whole / 3600;
  const std::uint64_t minutes = whole / 60 % 60;
  return (hours > 0 ? std::to_string(hours) + ":" + two_digits(minutes) : std::to_string(minutes)) +
         ":" + two_digits(whole % 60);
}

}  // namespace

Progress::Progress(std::string what, std::uint64_t total)
    : what_(std::move(what)),
      total_(total),
      is_watched_(isatty(STDERR_FILENO) == 1),
      next_(begin_ + kNotYet) {}

Progress::~Progress() {
  if (has_written_) {
    std::cerr << "\r\033[K" << std::flush;
  }
}

void Progress::show(std::uint64_t done, std::optional<double> part) {
  const auto now = Clock::now();
  if (!is_watched_ || now < next_) {
    return;
  }
  next_ = now + kEvery;
  has_written_ = true;
  std::cerr << "\r\033[K" << progress_line(what_, done, total_, part, now - begin_) << std::flush;
}

std::string progress_line(const std::string& what, std::uint64_t done, std::uint64_t total,
                          std::optional<double> part, std::chrono::duration<double> since_begin) {
  constexpr std::size_t kBar = 20;
  constexpr double kSoonestS = 2;       // before that nobody knows how fast it is
  constexpr double kLongestS = 86'400;  // what would take days is not believed
  std::string line = what + " " + std::to_string(done);
  if (total > 0) {
    line += " of " + std::to_string(total);
    part = part.value_or(static_cast<double>(done) / static_cast<double>(total));
  }
  if (!part) {
    return line;
  }
  const double known = std::clamp(*part, 0.0, 1.0);
  const auto filled = static_cast<std::size_t>(known * kBar);
  line += " [" + std::string(filled, '#') + std::string(kBar - filled, '.') + "] " +
          std::to_string(static_cast<int>(known * 100)) + " %";
  const double left_s = since_begin.count() * (1 - known) / known;
  if (since_begin.count() >= kSoonestS && known > 0 && left_s < kLongestS) {
    line += ", " + words_of_time(left_s) + " left";
  }
  return line;
}

}  // namespace iog::tools
