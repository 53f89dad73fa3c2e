// What a device says of its own state, as a message of ROS 2, serialised.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "tools/formats/ros/grid_messages.hpp"

namespace iog::tools::ros {

extern const MessageType kDiagnosticArray;  // diagnostic_msgs/msg/DiagnosticArray

// Numbers of diagnostic_msgs/msg/DiagnosticStatus.
enum class DiagnosticLevel : std::uint8_t { kOk, kWarn, kError };

struct Diagnostic {
  DiagnosticLevel level = DiagnosticLevel::kOk;
  std::string name;     // of what it speaks
  std::string message;  // in a few words
  std::vector<std::pair<std::string, std::string>> values{};
};

// diagnostic_msgs/msg/DiagnosticArray. hardware_id: of the device that all of them speak of.
[[nodiscard]] std::vector<std::byte> diagnostic_array(std::span<const Diagnostic> diagnostics,
                                                      std::string_view hardware_id,
                                                      std::uint64_t stamp_us);

}  // namespace iog::tools::ros
