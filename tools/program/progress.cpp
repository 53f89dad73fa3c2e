#include "tools/program/progress.hpp"

#include <iostream>
#include <unistd.h>
#include <utility>

namespace iog::tools {

Progress::Progress(std::string what, std::uint64_t total)
    : what_(std::move(what)), total_(total), is_watched_(isatty(STDERR_FILENO) == 1) {}

Progress::~Progress() {
  if (has_written_) {
    std::cerr << "\r\033[K" << std::flush;
  }
}

void Progress::show(std::uint64_t done) {
  const auto now = std::chrono::steady_clock::now();
  if (!is_watched_ || now < next_) {
    return;
  }
  next_ = now + std::chrono::milliseconds(200);
  has_written_ = true;
  std::cerr << "\r\033[K" << what_ << ' ' << done;
  if (total_ > 0) {
    std::cerr << " of " << total_;
  }
  std::cerr << std::flush;
}

}  // namespace iog::tools
