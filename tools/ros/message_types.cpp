// The definitions as ROS 2 and Foxglove publish them, without their comments. A reader checks the
// names and types of the fields; those of the types that a message is made of follow behind a line
// of 80 equals signs.
#include "tools/ros/grid_messages.hpp"

namespace iog::tools::ros {

const MessageType kOccupancyGrid{.name = "nav_msgs/msg/OccupancyGrid",
                                 .definition = R"(std_msgs/Header header
MapMetaData info
int8[] data

================================================================================
MSG: std_msgs/Header
builtin_interfaces/Time stamp
string frame_id

================================================================================
MSG: builtin_interfaces/Time
int32 sec
uint32 nanosec

================================================================================
MSG: nav_msgs/MapMetaData
builtin_interfaces/Time map_load_time
float32 resolution
uint32 width
uint32 height
geometry_msgs/Pose origin

================================================================================
MSG: geometry_msgs/Pose
Point position
Quaternion orientation

================================================================================
MSG: geometry_msgs/Point
float64 x
float64 y
float64 z

================================================================================
MSG: geometry_msgs/Quaternion
float64 x 0
float64 y 0
float64 z 0
float64 w 1
)"};

const MessageType kImage{.name = "sensor_msgs/msg/Image", .definition = R"(std_msgs/Header header
uint32 height
uint32 width
string encoding
uint8 is_bigendian
uint32 step
uint8[] data

================================================================================
MSG: std_msgs/Header
builtin_interfaces/Time stamp
string frame_id

================================================================================
MSG: builtin_interfaces/Time
int32 sec
uint32 nanosec
)"};

const MessageType kFoxgloveGrid{.name = "foxglove_msgs/msg/Grid",
                                .definition = R"(builtin_interfaces/Time timestamp
string frame_id
geometry_msgs/Pose pose
uint32 column_count
foxglove_msgs/Vector2 cell_size
uint32 row_stride
uint32 cell_stride
foxglove_msgs/PackedElementField[] fields
uint8[] data

================================================================================
MSG: builtin_interfaces/Time
int32 sec
uint32 nanosec

================================================================================
MSG: geometry_msgs/Pose
Point position
Quaternion orientation

================================================================================
MSG: geometry_msgs/Point
float64 x
float64 y
float64 z

================================================================================
MSG: geometry_msgs/Quaternion
float64 x 0
float64 y 0
float64 z 0
float64 w 1

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
)"};

const MessageType kUint8MultiArray{.name = "std_msgs/msg/UInt8MultiArray",
                                   .definition = R"(MultiArrayLayout layout
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
)"};

}  // namespace iog::tools::ros
