#include "tools/clouds/foxglove_clouds.hpp"

#include <bit>
#include <cstdint>
#include <protozero/pbf_reader.hpp>
#include <utility>

#include "tools/clouds/laser_ranges.hpp"
#include "tools/clouds/point_cloud.hpp"
#include "tools/formats/ros/cdr_reader.hpp"
#include "tools/program/exit_status.hpp"
#include "wire/byte_order.hpp"

namespace iog::tools {
namespace {

using ByteView = std::span<const std::byte>;

// A field of a message of Protocol Buffers: a number of any width, or bytes.
struct ProtoField {
  std::uint32_t number = 0;
  std::uint64_t value = 0;
  ByteView bytes{};
  bool has_bytes = false;

  [[nodiscard]] double as_double() const { return std::bit_cast<double>(value); }
};

template <typename Take>
void for_each_field(ByteView message, const Take& take) {
  using Wire = protozero::pbf_wire_type;
  protozero::pbf_reader in(reinterpret_cast<const char*>(message.data()), message.size());
  while (in.next()) {
    ProtoField field{.number = in.tag()};
    if (in.wire_type() == Wire::varint) {
      field.value = in.get_uint64();
    } else if (in.wire_type() == Wire::fixed32) {
      field.value = in.get_fixed32();
    } else if (in.wire_type() == Wire::fixed64) {
      field.value = in.get_fixed64();
    } else {
      const protozero::data_view view = in.get_view();
      field.bytes = std::as_bytes(std::span(view.data(), view.size()));
      field.has_bytes = true;
    }
    take(field);
  }
}

// google.protobuf.Timestamp.
std::uint64_t stamp_in(ByteView message) {
  std::uint64_t us = 0;
  for_each_field(message, [&](const ProtoField& its) {
    us += its.number == 1 ? its.value * 1'000'000 : its.number == 2 ? its.value / 1000 : 0;
  });
  return us;
}

struct Cloud {
  CloudRecords records{};
  std::size_t stride = 0;

  // foxglove.PackedElementField has each unsigned type before the signed one, PointField behind it.
  void add_field(const std::string& name, std::size_t at, std::size_t type,
                 const std::string& what) {
    const bool is_integer = type >= 1 && type <= 6;
    CloudField field = field_of_type(name, is_integer ? ((type - 1) ^ 1U) + 1 : type, what);
    field.at = at;
    iog::tools::add_field(records, std::move(field), what);
  }
};

Cloud cloud_in(ByteView message, const std::string& what) {
  Cloud cloud;
  for_each_field(message, [&](const ProtoField& its) {
    if (its.number == 1) {
      cloud.records.stamp_us = stamp_in(its.bytes);
    } else if (its.number == 4) {
      cloud.stride = static_cast<std::uint32_t>(its.value);
    } else if (its.number == 5) {
      std::string name;
      std::size_t at = 0;
      std::size_t type = 0;
      for_each_field(its.bytes, [&](const ProtoField& of) {
        if (of.number == 1) {
          name.assign(reinterpret_cast<const char*>(of.bytes.data()), of.bytes.size());
        }
        at = of.number == 2 ? static_cast<std::uint32_t>(of.value) : at;
        type = of.number == 3 ? of.value : type;
      });
      cloud.add_field(name, at, type, what);
    } else if (its.number == 6) {
      cloud.records.bytes = its.bytes;
    }
  });
  return cloud;
}

void skip_frame_and_pose(ros::CdrReader& in) {
  static_cast<void>(in.text());
  for (int i = 0; i < 7; ++i) {
    static_cast<void>(in.f64());
  }
}

Cloud cloud_in(ros::CdrReader& in, const std::string& what) {
  Cloud cloud{.records = {.stamp_us = in.stamp_us()}};
  skip_frame_and_pose(in);
  cloud.stride = in.u32();
  for (std::size_t left = in.u32(); left > 0; --left) {
    const std::string name = in.text();
    const std::size_t at = in.u32();
    const std::size_t type = in.u8();
    in.must_be_whole();
    cloud.add_field(name, at, type, what);
  }
  cloud.records.bytes = in.sequence(1);
  in.must_be_whole();
  return cloud;
}

void add_doubles(ByteView bytes, LaserRanges& scan) {
  for (; bytes.size() >= 8 && scan.ranges_m.size() <= kMostCloudPoints; bytes = bytes.subspan(8)) {
    scan.ranges_m.push_back(std::bit_cast<double>(wire::load_le64(bytes.first<8>())));
  }
}

// Of too many ranges one too many is kept.
LaserRanges scan_in(ByteView message) {
  LaserRanges scan;
  for_each_field(message, [&](const ProtoField& its) {
    if (its.number == 1) {
      scan.stamp_us = stamp_in(its.bytes);
    } else if (its.number == 4) {
      scan.first_rad = its.as_double();
    } else if (its.number == 5) {
      scan.last_rad = its.as_double();
    } else if (its.number == 6 && !its.has_bytes && scan.ranges_m.size() <= kMostCloudPoints) {
      scan.ranges_m.push_back(its.as_double());  // one by one; or packed
    } else if (its.number == 6) {
      add_doubles(its.bytes, scan);
    }
  });
  return scan;
}

LaserRanges scan_in(ros::CdrReader& in) {
  LaserRanges scan{.stamp_us = in.stamp_us()};
  skip_frame_and_pose(in);
  scan.first_rad = in.f64();
  scan.last_rad = in.f64();
  for (std::size_t left = in.u32(); left > 0 && scan.ranges_m.size() <= kMostCloudPoints; --left) {
    scan.ranges_m.push_back(in.f64());
    in.must_be_whole();
  }
  in.must_be_whole();
  return scan;
}

std::string frame_in(ByteView message) {
  std::string frame;
  for_each_field(message, [&](const ProtoField& its) {
    if (its.number == 2) {
      frame.assign(reinterpret_cast<const char*>(its.bytes.data()), its.bytes.size());
    }
  });
  return frame;
}

std::string frame_in(ros::CdrReader& in) {
  static_cast<void>(in.stamp_us());
  std::string frame = in.text();
  in.must_be_whole();
  return frame;
}

// What read(message or its reader) makes of either encoding.
template <typename Read>
auto read_either(ByteView message, bool is_cdr, const std::string& what, const Read& read) {
  if (is_cdr) {
    ros::CdrReader in(message, what);
    return read(in);
  }
  try {
    return read(message);
  } catch (const protozero::exception&) {
    throw UsageError(what + ": the message is damaged or cut off");
  }
}

}  // namespace

SeenCloud cloud_of_foxglove(ByteView message, bool is_cdr, TimeUnit& unit,
                            const std::string& what) {
  Cloud cloud = read_either(message, is_cdr, what, [&](auto& in) { return cloud_in(in, what); });
  cloud.records.count = cloud.stride == 0 ? 0 : cloud.records.bytes.size() / cloud.stride;
  set_stride(cloud.records, cloud.stride, what);
  return cloud_of(cloud.records, unit, what);
}

SeenCloud scan_of_foxglove(ByteView message, bool is_cdr, const std::string& what) {
  LaserRanges scan = read_either(message, is_cdr, what, [&](auto& in) { return scan_in(in); });
  const auto steps = static_cast<double>(scan.ranges_m.size()) - 1;
  scan.step_rad = steps > 0 ? (scan.last_rad - scan.first_rad) / steps : 0;
  return cloud_of_ranges(scan, what);
}

std::string frame_of_foxglove(ByteView message, bool is_cdr, const std::string& what) {
  return read_either(message, is_cdr, what, [](auto& in) { return frame_in(in); });
}

}  // namespace iog::tools
