// Which messages of a numbered stream are missing, late or doubled.
#pragma once

#include <cstddef>
#include <cstdint>
#include <set>

namespace iog::tools {

class SequenceWatch {
 public:
  enum class Arrival : std::uint8_t { kInOrder, kLate, kRepeated };

  // Classifies the next number that has arrived. Numbers wrap; the first one is taken as it is.
  Arrival arrive(std::uint32_t sequence);

  // The stream starts again; what has been counted is kept.
  void restart();

  // Whether one of these numbers, the last one excluded, is still waited for.
  [[nodiscard]] bool is_missing(std::uint32_t first, std::uint32_t end) const;

  [[nodiscard]] std::uint32_t expected() const { return expected_; }
  [[nodiscard]] std::uint64_t lost() const { return lost_; }  // a late one is lost until it comes

 private:
  // A number that is missing for longer than this is not waited for.
  static constexpr std::uint32_t kPatience = 4096;

  bool has_started_ = false;
  std::uint32_t expected_ = 0;
  std::uint64_t lost_ = 0;
  std::set<std::uint32_t> missing_;
};

}  // namespace iog::tools
