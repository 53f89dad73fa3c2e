// What definitions of messages are put together from: types that several are made of.
#pragma once

#include <algorithm>
#include <array>
#include <string_view>

namespace iog::tools::ros {

// Texts one behind the other, joined by the compiler.
template <const std::string_view&... kParts>
class Joined {
  static constexpr auto make() {
    std::array<char, (kParts.size() + ...)> letters{};
    auto* end = letters.data();
    ((end = std::ranges::copy(kParts, end).out), ...);
    return letters;
  }
  static constexpr auto kLetters = make();

 public:
  static constexpr std::string_view kText{kLetters.data(), kLetters.size()};
};

inline constexpr std::string_view kTime = R"(
================================================================================
MSG: builtin_interfaces/Time
int32 sec
uint32 nanosec
)";

inline constexpr std::string_view kHeader = R"(
================================================================================
MSG: std_msgs/Header
builtin_interfaces/Time stamp
string frame_id
)";

inline constexpr std::string_view kPose = R"(
================================================================================
MSG: geometry_msgs/Pose
Point position
Quaternion orientation

================================================================================
MSG: geometry_msgs/Point
float64 x
float64 y
float64 z
)";

inline constexpr std::string_view kQuaternion = R"(
================================================================================
MSG: geometry_msgs/Quaternion
float64 x 0
float64 y 0
float64 z 0
float64 w 1
)";

inline constexpr std::string_view kVector3 = R"(
================================================================================
MSG: geometry_msgs/Vector3
float64 x
float64 y
float64 z
)";

}  // namespace iog::tools::ros
