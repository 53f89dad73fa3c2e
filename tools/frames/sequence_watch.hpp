// Which messages of a numbered stream are missing, late or doubled.
#pragma once

#include <cstdint>
#include <set>

namespace iog::tools {

class SequenceWatch {
 public:
  enum class Arrival : std::uint8_t { kInOrder, kLate, kRepeated };

  // Classifies the next number that has arrived. Numbers wrap. Where the first one stands is where
  // the stream begins; what was sent shortly before it may still come, late, and was never lost.
  Arrival arrive(std::uint32_t sequence);

  // The stream starts again; what has been counted is kept.
  void restart();

  [[nodiscard]] std::uint32_t expected() const { return expected_; }
  [[nodiscard]] std::uint64_t lost() const { return lost_; }  // a late one is lost until it comes

 private:
  // A number that is missing for longer than this is not waited for.
  static constexpr std::uint32_t kPatience = 4096;
  // How far before the first one the stream may begin: some frames.
  static constexpr std::uint32_t kBeginning = 1024;

  void wait_for(std::uint32_t first, std::uint32_t end);

  bool has_started_ = false;
  std::uint32_t first_ = 0;
  std::uint32_t expected_ = 0;
  std::uint64_t lost_ = 0;
  std::set<std::uint32_t> missing_;
};

}  // namespace iog::tools
