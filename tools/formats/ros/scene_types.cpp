// Definitions of what draws objects, as in message_types.cpp.
#include "tools/formats/ros/grid_messages.hpp"
#include "tools/formats/ros/type_parts.hpp"

namespace iog::tools::ros {
namespace {

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

constexpr std::string_view kMarkerArrayFields = R"(visualization_msgs/Marker[] markers
)";

constexpr std::string_view kMarker = R"(
================================================================================
MSG: visualization_msgs/Marker
int32 ARROW=0
int32 CUBE=1
int32 TEXT_VIEW_FACING=9
int32 ADD=0
int32 DELETE=2
int32 DELETEALL=3
std_msgs/Header header
string ns
int32 id
int32 type
int32 action
geometry_msgs/Pose pose
geometry_msgs/Vector3 scale
std_msgs/ColorRGBA color
builtin_interfaces/Duration lifetime
bool frame_locked
geometry_msgs/Point[] points
std_msgs/ColorRGBA[] colors
string texture_resource
sensor_msgs/CompressedImage texture
UVCoordinate[] uv_coordinates
string text
string mesh_resource
MeshFile mesh_file
bool mesh_use_embedded_materials

================================================================================
MSG: visualization_msgs/UVCoordinate
float32 u
float32 v

================================================================================
MSG: visualization_msgs/MeshFile
string filename
uint8[] data

================================================================================
MSG: sensor_msgs/CompressedImage
std_msgs/Header header
string format
uint8[] data

================================================================================
MSG: std_msgs/ColorRGBA
float32 r
float32 g
float32 b
float32 a

================================================================================
MSG: builtin_interfaces/Duration
int32 sec
uint32 nanosec
)";

}  // namespace

const MessageType kSceneUpdate{
    .name = "foxglove_msgs/msg/SceneUpdate",
    .definition = Joined<kSceneUpdateFields, kTime, kSceneEntities, kScenePrimitives, kPose,
                         kQuaternion, kVector3>::kText};

const MessageType kMarkerArray{
    .name = "visualization_msgs/msg/MarkerArray",
    .definition =
        Joined<kMarkerArrayFields, kMarker, kHeader, kTime, kPose, kQuaternion, kVector3>::kText};

}  // namespace iog::tools::ros
