// Encodes and decodes the poses and standard deviations in all messages. The byte order is big
// endian, as specified in docs/spec.md 5.1.
#pragma once

#include <optional>

#include "pose/message.hpp"
#include "wire/byte_reader.hpp"
#include "wire/byte_writer.hpp"

namespace iog::pose {

// Represents an unknown map transform. All values of this transform, including its standard
// deviations, are zero.
inline constexpr MapTransform kNoMap{.sigma = {.position_mm = 0, .heading_10urad = 0}};

void write(const Pose& pose, wire::ByteWriter& out);                        // 12 bytes
void write(const Sigma& sigma, wire::ByteWriter& out);                      // 4 bytes
void write(const std::optional<MapTransform>& map, wire::ByteWriter& out);  // 24 bytes

[[nodiscard]] Pose read_pose(wire::ByteReader& in);
[[nodiscard]] Sigma read_sigma(wire::ByteReader& in);
[[nodiscard]] MapTransform read_map_transform(wire::ByteReader& in);

}  // namespace iog::pose
