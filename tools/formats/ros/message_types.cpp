// The definitions as ROS 2 and Foxglove publish them, without their comments. A reader checks the
// names and types of the fields; those of the types that a message is made of follow behind a line
// of 80 equals signs.
#include <algorithm>
#include <array>

#include "tools/formats/ros/grid_messages.hpp"

namespace iog::tools::ros {
namespace {

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

constexpr std::string_view kTime = R"(
================================================================================
MSG: builtin_interfaces/Time
int32 sec
uint32 nanosec
)";

constexpr std::string_view kHeader = R"(
================================================================================
MSG: std_msgs/Header
builtin_interfaces/Time stamp
string frame_id
)";

constexpr std::string_view kPose = R"(
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

constexpr std::string_view kQuaternion = R"(
================================================================================
MSG: geometry_msgs/Quaternion
float64 x 0
float64 y 0
float64 z 0
float64 w 1
)";

constexpr std::string_view kOccupancyGridFields = R"(std_msgs/Header header
MapMetaData info
int8[] data
)";

constexpr std::string_view kMapMetaData = R"(
================================================================================
MSG: nav_msgs/MapMetaData
builtin_interfaces/Time map_load_time
float32 resolution
uint32 width
uint32 height
geometry_msgs/Pose origin
)";

constexpr std::string_view kImageFields = R"(std_msgs/Header header
uint32 height
uint32 width
string encoding
uint8 is_bigendian
uint32 step
uint8[] data
)";

constexpr std::string_view kPointCloudFields = R"(std_msgs/Header header
uint32 height
uint32 width
PointField[] fields
bool is_bigendian
uint32 point_step
uint32 row_step
uint8[] data
bool is_dense
)";

constexpr std::string_view kPointField = R"(
================================================================================
MSG: sensor_msgs/PointField
uint8 INT8=1
uint8 UINT8=2
uint8 INT16=3
uint8 UINT16=4
uint8 INT32=5
uint8 UINT32=6
uint8 FLOAT32=7
uint8 FLOAT64=8
string name
uint32 offset
uint8 datatype
uint32 count
)";

constexpr std::string_view kFoxgloveGridFields = R"(builtin_interfaces/Time timestamp
string frame_id
geometry_msgs/Pose pose
uint32 column_count
foxglove_msgs/Vector2 cell_size
uint32 row_stride
uint32 cell_stride
foxglove_msgs/PackedElementField[] fields
uint8[] data
)";

constexpr std::string_view kCellTypes = R"(
================================================================================
MSG: foxglove_msgs/Vector2
float64 x
float64 y

================================================================================
MSG: foxglove_msgs/PackedElementField
uint8 UNKNOWN=0
uint8 UINT8=1
uint8 INT8=2
uint8 UINT16=3
uint8 INT16=4
uint8 UINT32=5
uint8 INT32=6
uint8 FLOAT32=7
uint8 FLOAT64=8
string name
uint32 offset
uint8 type
)";

constexpr std::string_view kUint8MultiArrayText = R"(MultiArrayLayout layout
uint8[] data

================================================================================
MSG: std_msgs/MultiArrayLayout
MultiArrayDimension[] dim
uint32 data_offset

================================================================================
MSG: std_msgs/MultiArrayDimension
string label
uint32 size
uint32 stride
)";

constexpr std::string_view kTfMessageFields = R"(geometry_msgs/TransformStamped[] transforms
)";

constexpr std::string_view kTransformStamped = R"(
================================================================================
MSG: geometry_msgs/TransformStamped
std_msgs/Header header
string child_frame_id
Transform transform

================================================================================
MSG: geometry_msgs/Transform
Vector3 translation
Quaternion rotation
)";

constexpr std::string_view kVector3 = R"(
================================================================================
MSG: geometry_msgs/Vector3
float64 x
float64 y
float64 z
)";

constexpr std::string_view kSceneUpdateFields = R"(foxglove_msgs/SceneEntityDeletion[] deletions
foxglove_msgs/SceneEntity[] entities
)";

constexpr std::string_view kSceneEntities = R"(
================================================================================
MSG: builtin_interfaces/Duration
int32 sec
uint32 nanosec

================================================================================
MSG: foxglove_msgs/SceneEntityDeletion
uint8 MATCHING_ID=0
uint8 ALL=1
builtin_interfaces/Time timestamp
uint8 type
string id

================================================================================
MSG: foxglove_msgs/SceneEntity
builtin_interfaces/Time timestamp
string frame_id
string id
builtin_interfaces/Duration lifetime
bool frame_locked
foxglove_msgs/KeyValuePair[] metadata
foxglove_msgs/ArrowPrimitive[] arrows
foxglove_msgs/CubePrimitive[] cubes
foxglove_msgs/SpherePrimitive[] spheres
foxglove_msgs/CylinderPrimitive[] cylinders
foxglove_msgs/LinePrimitive[] lines
foxglove_msgs/TriangleListPrimitive[] triangles
foxglove_msgs/TextPrimitive[] texts
foxglove_msgs/ModelPrimitive[] models

================================================================================
MSG: foxglove_msgs/KeyValuePair
string key
string value

================================================================================
MSG: foxglove_msgs/Color
float64 r
float64 g
float64 b
float64 a
)";

constexpr std::string_view kScenePrimitives = R"(
================================================================================
MSG: foxglove_msgs/ArrowPrimitive
geometry_msgs/Pose pose
float64 shaft_length
float64 shaft_diameter
float64 head_length
float64 head_diameter
foxglove_msgs/Color color

================================================================================
MSG: foxglove_msgs/CubePrimitive
geometry_msgs/Pose pose
geometry_msgs/Vector3 size
foxglove_msgs/Color color

================================================================================
MSG: foxglove_msgs/SpherePrimitive
geometry_msgs/Pose pose
geometry_msgs/Vector3 size
foxglove_msgs/Color color

================================================================================
MSG: foxglove_msgs/CylinderPrimitive
geometry_msgs/Pose pose
geometry_msgs/Vector3 size
float64 bottom_scale
float64 top_scale
foxglove_msgs/Color color

================================================================================
MSG: foxglove_msgs/LinePrimitive
uint8 LINE_STRIP=0
uint8 LINE_LOOP=1
uint8 LINE_LIST=2
uint8 type
geometry_msgs/Pose pose
float64 thickness
bool scale_invariant
geometry_msgs/Point[] points
foxglove_msgs/Color color
foxglove_msgs/Color[] colors
uint32[] indices

================================================================================
MSG: foxglove_msgs/TriangleListPrimitive
geometry_msgs/Pose pose
geometry_msgs/Point[] points
foxglove_msgs/Color color
foxglove_msgs/Color[] colors
uint32[] indices

================================================================================
MSG: foxglove_msgs/TextPrimitive
geometry_msgs/Pose pose
bool billboard
float64 font_size
bool scale_invariant
foxglove_msgs/Color color
string text

================================================================================
MSG: foxglove_msgs/ModelPrimitive
geometry_msgs/Pose pose
geometry_msgs/Vector3 scale
foxglove_msgs/Color color
bool override_color
string url
string media_type
uint8[] data
)";

}  // namespace

const MessageType kOccupancyGrid{
    .name = "nav_msgs/msg/OccupancyGrid",
    .definition =
        Joined<kOccupancyGridFields, kHeader, kTime, kMapMetaData, kPose, kQuaternion>::kText};

const MessageType kImage{.name = "sensor_msgs/msg/Image",
                         .definition = Joined<kImageFields, kHeader, kTime>::kText};

const MessageType kPointCloud{
    .name = "sensor_msgs/msg/PointCloud2",
    .definition = Joined<kPointCloudFields, kHeader, kTime, kPointField>::kText};

const MessageType kFoxgloveGrid{
    .name = "foxglove_msgs/msg/Grid",
    .definition = Joined<kFoxgloveGridFields, kTime, kPose, kQuaternion, kCellTypes>::kText};

const MessageType kTfMessage{
    .name = "tf2_msgs/msg/TFMessage",
    .definition =
        Joined<kTfMessageFields, kTransformStamped, kVector3, kQuaternion, kHeader, kTime>::kText};

const MessageType kSceneUpdate{
    .name = "foxglove_msgs/msg/SceneUpdate",
    .definition = Joined<kSceneUpdateFields, kTime, kSceneEntities, kScenePrimitives, kPose,
                         kQuaternion, kVector3>::kText};

const MessageType kUint8MultiArray{.name = "std_msgs/msg/UInt8MultiArray",
                                   .definition = kUint8MultiArrayText};

}  // namespace iog::tools::ros
