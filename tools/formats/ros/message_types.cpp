// The definitions as ROS 2 and Foxglove publish them, without their comments. A reader checks the
// names and types of the fields; those of the types that a message is made of follow behind a line
// of 80 equals signs.
#include "tools/formats/ros/grid_messages.hpp"
#include "tools/formats/ros/type_parts.hpp"

namespace iog::tools::ros {
namespace {

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

const MessageType kUint8MultiArray{.name = "std_msgs/msg/UInt8MultiArray",
                                   .definition = kUint8MultiArrayText};

}  // namespace iog::tools::ros
