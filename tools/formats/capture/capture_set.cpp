#include "tools/formats/capture/capture_set.hpp"

#include <algorithm>
#include <filesystem>
#include <numeric>
#include <utility>

#include "tools/program/exit_status.hpp"

namespace iog::tools {

CaptureSet::CaptureSet(const std::vector<std::string>& paths) {
  for (const std::string& path : paths) {
    std::error_code ignored;
    if (std::ranges::any_of(files_, [&](const File& file) {
          return std::filesystem::equivalent(file.path, path, ignored);
        })) {
      throw UsageError(path + ": this capture is given twice");
    }
    File& file = files_.emplace_back(File{path, std::make_unique<PcapReader>(path)});
    file.next = paths.size() > 1 ? file.reader->next() : std::nullopt;
  }
}

std::optional<CapturedDatagram> CaptureSet::next() {
  if (files_.size() == 1) {
    return files_.front().reader->next();
  }
  const auto first = std::ranges::min_element(files_, {}, [](const File& file) {
    return file.next ? file.next->time_us : ~std::uint64_t{0};
  });
  if (first->next) {
    note_gap(*first);
    last_us_ = first->next->time_us;
  }
  return std::exchange(first->next, first->next ? first->reader->next() : std::nullopt);
}

void CaptureSet::note_gap(const File& file) {
  const bool is_its_first = file.reader->counts().datagrams == 1;
  if (is_its_first && last_us_ > 0 &&
      file.next->time_us > last_us_ + CaptureClock::kLongestPauseUs) {
    words_ += (words_.empty() ? "" : ", ") + file.path + " begins " +
              std::to_string((file.next->time_us - last_us_) / 1'000'000) +
              " s after the captures before it end";
  }
}

std::optional<PcapReader::Place> CaptureSet::place() const {
  return files_.size() == 1 ? files_.front().reader->place() : std::nullopt;
}

std::uint64_t CaptureSet::datagrams() const {
  return std::accumulate(
      files_.begin(), files_.end(), std::uint64_t{0},
      [](std::uint64_t sum, const File& file) { return sum + file.reader->counts().datagrams; });
}

}  // namespace iog::tools
