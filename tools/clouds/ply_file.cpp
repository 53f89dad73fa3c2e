#include "tools/clouds/ply_file.hpp"

#include <algorithm>
#include <array>
#include <sstream>
#include <string_view>
#include <vector>

#include "tools/clouds/point_cloud.hpp"
#include "tools/program/exit_status.hpp"
#include "tools/program/printable.hpp"

namespace iog::tools {
namespace {

// The names of each type, in the order of sensor_msgs/PointField's numbers, twice.
CloudField field_of(const std::string& type, const std::string& name, const std::string& path) {
  constexpr std::size_t kTypes = 8;
  constexpr std::array<std::string_view, 2 * kTypes> kNames{
      "char", "uchar", "short", "ushort", "int",   "uint",   "float",   "double",
      "int8", "uint8", "int16", "uint16", "int32", "uint32", "float32", "float64"};
  const auto found = std::ranges::find(kNames, type);
  if (found == kNames.end()) {
    throw UsageError(path + ": property " + printable(name) + " has an unknown type, " +
                     printable(type));
  }
  return field_of_type(name, static_cast<std::size_t>(found - kNames.begin()) % kTypes + 1, path);
}

// The vertices, which are its first element, and how they are written.
struct PlyHead {
  std::string format{};
  std::string element{};  // the one whose properties come
  std::size_t lines = 0;
  bool is_last = true;  // of the elements
  bool is_whole = false;
  CloudRecords camera{};  // the element behind the vertices, if it is one camera
};

// The camera serves only for a remark: what is wrong with it refuses no cloud.
void add_to_camera(const std::string& type, const std::string& name, const std::string& path,
                   CloudRecords& camera) {
  try {
    add_field(camera, field_of(type, name, path), path);
  } catch (const UsageError&) {  // a list, too
    camera.count = 0;
  }
}

std::vector<std::byte> camera_row_of(TextRows text, const CloudRecords& camera,
                                     const std::string& path) {
  text.rows = camera.count;
  text.columns = camera.fields.size();
  try {
    return doubles_in(text, path);
  } catch (const UsageError&) {
    return {};
  }
}

void take_line(const std::string& line, const std::string& path, PlyHead& head,
               CloudRecords& records) {
  std::istringstream in(line);
  std::string key;
  std::string first;
  std::string second;
  in >> key >> first >> second;
  if (key == "format") {
    head.format = first;
  } else if (key == "element") {
    if (head.element.empty() && first != "vertex") {
      throw UsageError(path + ": its first element is " + printable(first) + ", not vertex");
    }
    head.camera.count = head.is_last && first == "camera" && second == "1" ? 1 : head.camera.count;
    head.element = first;
    head.is_last = first == "vertex";
    records.count = head.is_last ? whole_number_of(second, path) : records.count;
  } else if (key == "property" && head.element == "vertex" && first == "list") {
    throw UsageError(path + ": its points have a property that is a list, which is not read");
  } else if (key == "property" && head.element == "vertex") {
    add_field(records, field_of(first, second, path), path);
  } else if (key == "property" && head.element == "camera" && head.camera.count > 0) {
    add_to_camera(first, second, path, head.camera);
  }
  ++head.lines;
  head.is_whole = key == "end_header";
}

// Points one behind another.
void place_fields(bool are_words, CloudRecords& records) {
  std::size_t stride = 0;
  for (CloudField& field : records.fields) {
    if (are_words) {
      field.kind = CloudField::Kind::kFloat;
      field.bytes = 8;
    }
    field.at = stride;
    stride += field.bytes;
  }
  std::ranges::for_each(records.fields, [=](CloudField& field) { field.stride = stride; });
}

// The vertices of a text as doubles; the text becomes what is behind them.
std::vector<std::byte> rows_of(const PlyHead& head, TextRows& text, const std::string& path) {
  const std::size_t points = text.rows;
  std::vector<std::byte> doubles = doubles_in(text, path);
  TextRows more = text;
  more.rows = 1;
  if (head.is_last && !doubles_in(more, path).empty()) {
    throw UsageError(path + ": it has more rows than its " + std::to_string(points) + " points");
  }
  return doubles;
}

// Where the unit was, and its axes, as PCL writes them. Empty if that is the points' own frame, or
// if the record, with its bytes, is not whole.
std::string viewpoint_of(const CloudRecords& camera) {
  constexpr std::array<std::string_view, 12> kNames{"view_px", "view_py", "view_pz", "x_axisx",
                                                    "x_axisy", "x_axisz", "y_axisx", "y_axisy",
                                                    "y_axisz", "z_axisx", "z_axisy", "z_axisz"};
  std::ostringstream words("camera", std::ios::ate);
  bool is_own = true;
  for (const std::string_view name : kNames) {
    const auto field = std::ranges::find(camera.fields, name, &CloudField::name);
    if (camera.count == 0 || field == camera.fields.end() ||
        field->at + field->bytes > camera.bytes.size()) {
      return {};
    }
    const double number = number_at(camera, *field, 0);
    words << ' ' << number;
    is_own = is_own && number == (name.front() == name.back() ? 1 : 0);  // an axis along its own
  }
  return is_own ? std::string() : words.str();
}

}  // namespace

SeenCloud read_ply(const std::string& path, TimeUnit& unit, std::uint64_t stamp_us) {
  const std::vector<std::byte> file = read_cloud_file(path);
  CloudRecords records{.bytes = file, .stamp_us = stamp_us};
  PlyHead head;
  while (!records.bytes.empty() && !head.is_whole) {
    const auto end = std::ranges::find(records.bytes, std::byte{'\n'});
    const auto length = static_cast<std::size_t>(end - records.bytes.begin());
    const std::string line(reinterpret_cast<const char*>(records.bytes.data()), length);
    if (records.bytes.size() == file.size() && !line.starts_with("ply")) {
      break;
    }
    take_line(line, path, head, records);
    records.bytes = records.bytes.subspan(std::min(length + 1, records.bytes.size()));
  }
  if (!head.is_whole) {
    throw UsageError(path + ": this is no PLY file: its head has no end_header");
  }
  records.is_big_endian = head.format == "binary_big_endian";
  const bool is_ascii = head.format == "ascii";
  if (!is_ascii && !records.is_big_endian && head.format != "binary_little_endian") {
    throw UsageError(path + ": its format is " + printable(head.format) +
                     "; use ascii, binary_little_endian, binary_big_endian");
  }
  place_fields(is_ascii, records);
  check_count(records, path);
  if (!is_ascii && head.is_last && !records.fields.empty() &&
      records.bytes.size() >= (records.count + 1) * records.fields.front().stride) {
    throw UsageError(path + ": it has more bytes than its " + std::to_string(records.count) +
                     " points");
  }
  std::vector<std::byte> doubles;
  std::vector<std::byte> camera_doubles;
  if (is_ascii) {
    TextRows text{.text = records.bytes,
                  .line = head.lines + 1,
                  .rows = records.count,
                  .columns = records.fields.size()};
    doubles = rows_of(head, text, path);
    records.bytes = doubles;
    camera_doubles = camera_row_of(text, head.camera, path);
    head.camera.bytes = camera_doubles;
  } else if (!records.fields.empty()) {
    const std::size_t end = records.count * records.fields.front().stride;
    head.camera.bytes = records.bytes.subspan(std::min(end, records.bytes.size()));
    head.camera.is_big_endian = records.is_big_endian;
  }
  place_fields(is_ascii, head.camera);
  SeenCloud cloud = cloud_of(records, unit, path);
  cloud.viewpoint = viewpoint_of(head.camera);
  return cloud;
}

}  // namespace iog::tools
