#include "tools/formats/ros/diagnostic_messages.hpp"

#include "tools/formats/ros/grid_parts.hpp"
#include "tools/formats/ros/type_parts.hpp"

namespace iog::tools::ros {
namespace {

constexpr std::string_view kDiagnosticArrayFields = R"(std_msgs/Header header
DiagnosticStatus[] status
)";

constexpr std::string_view kDiagnosticStatus = R"(
================================================================================
MSG: diagnostic_msgs/DiagnosticStatus
byte OK=0
byte WARN=1
byte ERROR=2
byte STALE=3
byte level
string name
string message
string hardware_id
KeyValue[] values

================================================================================
MSG: diagnostic_msgs/KeyValue
string key
string value
)";

}  // namespace

const MessageType kDiagnosticArray{
    .name = "diagnostic_msgs/msg/DiagnosticArray",
    .definition = Joined<kDiagnosticArrayFields, kDiagnosticStatus, kHeader, kTime>::kText};

std::vector<std::byte> diagnostic_array(std::span<const Diagnostic> diagnostics,
                                        std::string_view hardware_id, std::uint64_t stamp_us) {
  CdrWriter out;
  put_stamp(out, stamp_us);
  out.put(std::string_view{});  // frame_id: of no place
  out.put(static_cast<std::uint32_t>(diagnostics.size()));
  for (const Diagnostic& diagnostic : diagnostics) {
    out.put(static_cast<std::uint8_t>(diagnostic.level));
    out.put(diagnostic.name);
    out.put(diagnostic.message);
    out.put(hardware_id);
    out.put(static_cast<std::uint32_t>(diagnostic.values.size()));
    for (const auto& [key, value] : diagnostic.values) {
      out.put(key);
      out.put(value);
    }
  }
  return out.take();
}

}  // namespace iog::tools::ros
