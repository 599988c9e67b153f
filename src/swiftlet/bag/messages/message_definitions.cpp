// SPDX-License-Identifier: Apache-2.0
// Copyright the Swiftlet authors

#include "swiftlet/bag/messages/message_definitions.hpp"

#include <algorithm>
#include <vector>

#include "swiftlet/base/contract.hpp"

namespace swiftlet {
namespace {

struct Definition {
  std::string_view type;
  std::string_view text;
};

// common_interfaces of ROS 2 (Apache-2.0) without their comments, and foxglove_msgs for ROS 2, as
// in foxglove-sdk (MIT).
constexpr Definition kDefinitions[]{
    {"builtin_interfaces/Time", "int32 sec\nuint32 nanosec\n"},
    {"builtin_interfaces/Duration", "int32 sec\nuint32 nanosec\n"},
    {"std_msgs/Header", "builtin_interfaces/Time stamp\nstring frame_id\n"},
    {"geometry_msgs/Transform",
     "geometry_msgs/Vector3 translation\ngeometry_msgs/Quaternion rotation\n"},
    {"geometry_msgs/TransformStamped",
     "std_msgs/Header header\nstring child_frame_id\ngeometry_msgs/Transform transform\n"},
    {"geometry_msgs/PoseStamped", "std_msgs/Header header\ngeometry_msgs/Pose pose\n"},
    {"geometry_msgs/PoseWithCovariance", "geometry_msgs/Pose pose\nfloat64[36] covariance\n"},
    {"geometry_msgs/Twist", "geometry_msgs/Vector3 linear\ngeometry_msgs/Vector3 angular\n"},
    {"geometry_msgs/TwistWithCovariance", "geometry_msgs/Twist twist\nfloat64[36] covariance\n"},
    {"tf2_msgs/TFMessage", "geometry_msgs/TransformStamped[] transforms\n"},
    {"nav_msgs/Path", "std_msgs/Header header\ngeometry_msgs/PoseStamped[] poses\n"},
    {"nav_msgs/Odometry", R"(std_msgs/Header header
string child_frame_id
geometry_msgs/PoseWithCovariance pose
geometry_msgs/TwistWithCovariance twist
)"},
    {"sensor_msgs/Image", R"(std_msgs/Header header
uint32 height
uint32 width
string encoding
uint8 is_bigendian
uint32 step
uint8[] data
)"},
    {"sensor_msgs/RegionOfInterest", R"(uint32 x_offset
uint32 y_offset
uint32 height
uint32 width
bool do_rectify
)"},
    {"sensor_msgs/CameraInfo", R"(std_msgs/Header header
uint32 height
uint32 width
string distortion_model
float64[] d
float64[9] k
float64[9] r
float64[12] p
uint32 binning_x
uint32 binning_y
sensor_msgs/RegionOfInterest roi
)"},
    {"sensor_msgs/PointField", R"(uint8 INT8=1
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
)"},
    {"sensor_msgs/PointCloud2", R"(std_msgs/Header header
uint32 height
uint32 width
sensor_msgs/PointField[] fields
bool is_bigendian
uint32 point_step
uint32 row_step
uint8[] data
bool is_dense
)"},
    {"geometry_msgs/Point", "float64 x\nfloat64 y\nfloat64 z\n"},
    {"geometry_msgs/Vector3", "float64 x\nfloat64 y\nfloat64 z\n"},
    {"geometry_msgs/Quaternion", "float64 x\nfloat64 y\nfloat64 z\nfloat64 w\n"},
    {"geometry_msgs/Pose", "geometry_msgs/Point position\ngeometry_msgs/Quaternion orientation\n"},
    {"foxglove_msgs/Color", "float64 r\nfloat64 g\nfloat64 b\nfloat64 a\n"},
    {"foxglove_msgs/PackedElementField", R"(string name
uint32 offset
uint8 UNKNOWN=0
uint8 UINT8=1
uint8 INT8=2
uint8 UINT16=3
uint8 INT16=4
uint8 UINT32=5
uint8 INT32=6
uint8 FLOAT32=7
uint8 FLOAT64=8
uint8 type
)"},
    {"foxglove_msgs/PointCloud", R"(builtin_interfaces/Time timestamp
string frame_id
geometry_msgs/Pose pose
uint32 point_stride
foxglove_msgs/PackedElementField[] fields
uint8[] data
)"},
    {"foxglove_msgs/VoxelGrid", R"(builtin_interfaces/Time timestamp
string frame_id
geometry_msgs/Pose pose
uint32 row_count
uint32 column_count
geometry_msgs/Vector3 cell_size
uint32 slice_stride
uint32 row_stride
uint32 cell_stride
foxglove_msgs/PackedElementField[] fields
uint8[] data
)"},
    {"foxglove_msgs/KeyValuePair", "string key\nstring value\n"},
    {"foxglove_msgs/SceneEntityDeletion", R"(builtin_interfaces/Time timestamp
uint8 MATCHING_ID=0
uint8 ALL=1
uint8 type
string id
)"},
    {"foxglove_msgs/ArrowPrimitive", R"(geometry_msgs/Pose pose
float64 shaft_length
float64 shaft_diameter
float64 head_length
float64 head_diameter
foxglove_msgs/Color color
)"},
    {"foxglove_msgs/CubePrimitive", R"(geometry_msgs/Pose pose
geometry_msgs/Vector3 size
foxglove_msgs/Color color
)"},
    {"foxglove_msgs/SpherePrimitive", R"(geometry_msgs/Pose pose
geometry_msgs/Vector3 size
foxglove_msgs/Color color
)"},
    {"foxglove_msgs/CylinderPrimitive", R"(geometry_msgs/Pose pose
geometry_msgs/Vector3 size
float64 bottom_scale
float64 top_scale
foxglove_msgs/Color color
)"},
    {"foxglove_msgs/LinePrimitive", R"(uint8 LINE_STRIP=0
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
)"},
    {"foxglove_msgs/TriangleListPrimitive", R"(geometry_msgs/Pose pose
geometry_msgs/Point[] points
foxglove_msgs/Color color
foxglove_msgs/Color[] colors
uint32[] indices
)"},
    {"foxglove_msgs/TextPrimitive", R"(geometry_msgs/Pose pose
bool billboard
float64 font_size
bool scale_invariant
foxglove_msgs/Color color
string text
)"},
    {"foxglove_msgs/ModelPrimitive", R"(geometry_msgs/Pose pose
geometry_msgs/Vector3 scale
foxglove_msgs/Color color
bool override_color
string url
string media_type
uint8[] data
)"},
    {"foxglove_msgs/SceneEntity", R"(builtin_interfaces/Time timestamp
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
)"},
    {"foxglove_msgs/SceneUpdate", R"(foxglove_msgs/SceneEntityDeletion[] deletions
foxglove_msgs/SceneEntity[] entities
)"},
    {"foxglove_msgs/FrameTransform", R"(builtin_interfaces/Time timestamp
string parent_frame_id
string child_frame_id
geometry_msgs/Vector3 translation
geometry_msgs/Quaternion rotation
)"},
    {"foxglove_msgs/FrameTransforms", "foxglove_msgs/FrameTransform[] transforms\n"},
    {"foxglove_msgs/CameraCalibration", R"(builtin_interfaces/Time timestamp
string frame_id
uint32 width
uint32 height
string distortion_model
float64[] d
float64[9] k
float64[9] r
float64[12] p
)"},
    {"foxglove_msgs/RawImage", R"(builtin_interfaces/Time timestamp
string frame_id
uint32 width
uint32 height
string encoding
uint32 step
uint8[] data
)"},
};

const Definition* find_definition(std::string_view type) {
  const auto* found = std::ranges::find(kDefinitions, type, &Definition::type);
  return found == std::end(kDefinitions) ? nullptr : found;
}

/// The types that the fields of a definition name, and those in them, each once. Definitions name
/// no type that leads back to them.
void collect(const Definition& definition, std::vector<const Definition*>& found) {
  std::string_view text = definition.text;
  while (!text.empty()) {
    const std::string_view line = text.substr(0, text.find('\n'));
    text.remove_prefix(std::min(line.size() + 1, text.size()));
    const std::string_view type = line.substr(0, line.find_first_of(" ["));
    const Definition* inner = find_definition(type);
    SWIFTLET_REQUIRE(inner != nullptr || type.find('/') == std::string_view::npos,
                     "every type that a definition names is in the table");
    if (inner == nullptr || std::ranges::find(found, inner) != found.end()) continue;
    found.push_back(inner);
    collect(*inner, found);
  }
}

}  // namespace

std::string message_definition(std::string_view type) {
  const Definition* root = find_definition(type);
  SWIFTLET_REQUIRE(root != nullptr, "the type is in the table");
  std::vector<const Definition*> inner;
  collect(*root, inner);
  std::string schema(root->text);
  for (const Definition* definition : inner) {
    schema += std::string(80, '=') + "\nMSG: " + std::string(definition->type) + "\n";
    schema += definition->text;
  }
  return schema;
}

}  // namespace swiftlet
