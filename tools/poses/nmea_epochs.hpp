// Epochs: the sentences of one time together, completed from the whole log.
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "tools/poses/nmea_cycle.hpp"

namespace iog::tools {

inline constexpr std::uint64_t kDayUs = 86'400'000'000U;

// Degrees, clockwise from north.
struct NmeaEpoch {
  std::uint64_t time_of_day_us = 0;
  std::size_t line = 0;
  std::uint64_t midnight_us = 0;
  std::optional<std::uint64_t> stated_midnight_us{};  // by RMC
  std::optional<double> latitude{};
  std::optional<double> longitude{};
  std::optional<double> speed_mps{};
  std::optional<double> course_deg{};
  std::optional<double> heading_deg{};
  double doubt_rad = 0;
  bool has_no_fix = false;

  [[nodiscard]] bool has_fix() const { return !has_no_fix && latitude && longitude; }
  [[nodiscard]] std::uint64_t time_us() const { return midnight_us + time_of_day_us; }
};

// Of one kind, in the order of the log; whether the log begins or ends within a damaged line.
struct UntimedSentences {
  std::vector<Untimed> all;
  bool is_cut_at_begin = false;
  bool is_cut_at_end = false;
};

// Gives each epoch its day, the course and speed of its VTG if there is no RMC, and the heading of
// its HDT or, between two epochs with one, the heading between. Notes what the log leaves open.
void complete(std::vector<NmeaEpoch>& epochs, const UntimedSentences& headings,
              const UntimedSentences& courses, std::vector<std::string>& notes);

}  // namespace iog::tools
