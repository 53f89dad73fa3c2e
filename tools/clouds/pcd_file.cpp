#include "tools/clouds/pcd_file.hpp"

#include <algorithm>
#include <map>
#include <string_view>
#include <vector>

#include "tools/clouds/point_cloud.hpp"
#include "tools/poses/text_fields.hpp"
#include "tools/program/exit_status.hpp"
#include "tools/program/joined.hpp"
#include "tools/program/printable.hpp"
#include "wire/byte_order.hpp"

namespace iog::tools {
namespace {

using Bytes = std::vector<std::byte>;
using Words = std::vector<std::string>;

// A file as it is read: the lines of its head by their first words, and where its data begins.
struct PcdFile {
  std::string path;
  std::map<std::string, Words> head{};
  std::span<const std::byte> data{};
  std::size_t lines = 0;  // of the head

  [[nodiscard]] UsageError error(const std::string& words) const {
    return UsageError(path + ": " + words);
  }
  [[nodiscard]] const Words& words(const std::string& key) const {
    const auto found = head.find(key);
    if (found == head.end() || found->second.empty()) {
      throw error("this is no PCD file: its head has no " + key);
    }
    return found->second;
  }
  [[nodiscard]] std::size_t number(const std::string& word) const {
    return whole_number_of(word, path);
  }
};

PcdFile file_of(const std::string& path, std::span<const std::byte> bytes) {
  PcdFile file{.path = path};
  while (!bytes.empty() && !file.head.contains("DATA")) {
    const auto end = std::ranges::find(bytes, std::byte{'\n'});
    const auto length = static_cast<std::size_t>(end - bytes.begin());
    const auto parts =
        words_of(std::string_view(reinterpret_cast<const char*>(bytes.data()), length));
    Words words(parts.begin(), parts.end());
    bytes = bytes.subspan(std::min(length + 1, bytes.size()));
    ++file.lines;
    if (!words.empty()) {
      const std::string key = words[0];
      words.erase(words.begin());
      file.head[key] = std::move(words);
    }
  }
  file.data = bytes;
  return file;
}

// Of points one behind another; the first number of each field.
void add_fields(const PcdFile& file, CloudRecords& records) {
  using Kind = CloudField::Kind;
  const Words& names = file.words("FIELDS");
  const Words& sizes = file.words("SIZE");
  const Words& types = file.words("TYPE");
  const Words counts = file.head.contains("COUNT") ? file.words("COUNT") : Words(names.size(), "1");
  if (sizes.size() != names.size() || types.size() != names.size() ||
      counts.size() != names.size()) {
    throw file.error("its head has not as many sizes, types and counts as fields");
  }
  std::size_t stride = 0;
  for (std::size_t i = 0; i < names.size(); ++i) {
    add_field(records,
              {.name = names[i],
               .kind = types[i] == "F"   ? Kind::kFloat
                       : types[i] == "U" ? Kind::kUnsigned
                                         : Kind::kSigned,
               .bytes = file.number(sizes[i]),
               .at = stride},
              file.path);
    stride += records.fields.back().bytes * file.number(counts[i]);
  }
  std::ranges::for_each(records.fields, [=](CloudField& field) { field.stride = stride; });
}

// The rows as doubles.
Bytes rows_of(const PcdFile& file, CloudRecords& records) {
  std::size_t numbers = 0;  // of a point
  for (std::size_t i = 0; i < records.fields.size(); ++i) {
    CloudField& field = records.fields[i];
    field.kind = CloudField::Kind::kFloat;
    field.bytes = 8;
    field.at = 8 * numbers;
    numbers += file.head.contains("COUNT") ? file.number(file.words("COUNT")[i]) : 1;
  }
  std::ranges::for_each(records.fields, [=](CloudField& field) { field.stride = 8 * numbers; });
  TextRows text{
      .text = file.data, .line = file.lines + 1, .rows = records.count, .columns = numbers};
  Bytes doubles = doubles_in(text, file.path);
  text.rows = 1;
  if (!doubles_in(text, file.path).empty()) {
    throw file.error("it has more rows than its " + std::to_string(records.count) + " points");
  }
  return doubles;
}

// Where the unit was, and how it was turned: x, y, z, and a quaternion whose w comes first. Empty
// if that is the points' own frame.
std::string viewpoint_of(const PcdFile& file) {
  constexpr std::size_t kW = 3;
  const auto found = file.head.find("VIEWPOINT");
  if (found == file.head.end()) {
    return {};
  }
  const Words& words = found->second;
  bool is_origin = words.size() == 7;
  for (std::size_t i = 0; i < words.size(); ++i) {
    is_origin = is_origin && (i == kW || number_in(words[i]) == 0.0);
  }
  return is_origin ? std::string() : printable("VIEWPOINT " + joined(words, " "));
}

// LZF (M. Lehmann): runs of up to 32 bytes, and repetitions of earlier ones. Whatever is wrong with
// it, at most `size` bytes and a repetition.
Bytes unpacked(std::span<const std::byte> packed, std::size_t size) {
  Bytes out;
  const auto next = [&] {
    const std::size_t byte = packed.empty() ? 0 : std::to_integer<std::size_t>(packed[0]);
    packed = packed.subspan(packed.empty() ? 0 : 1);
    return byte;
  };
  while (!packed.empty() && out.size() < size) {
    const std::size_t control = next();
    if (control < 32) {
      const auto run = packed.first(std::min(control + 1, packed.size()));
      out.insert(out.end(), run.begin(), run.end());
      packed = packed.subspan(run.size());
      continue;
    }
    const std::size_t length = (control >> 5) + (control >> 5 == 7 ? next() : 0) + 2;
    const std::size_t back = ((control & 31U) << 8 | next()) + 1;
    for (std::size_t i = 0; i < length && back <= out.size(); ++i) {
      out.push_back(out[out.size() - back]);
    }
  }
  return out;
}

// Field after field, of all points each.
Bytes columns_of(const PcdFile& file, CloudRecords& records) {
  if (file.data.size() < 8) {
    throw file.error("it ends before its points");
  }
  const std::size_t packed = wire::load_le32(file.data.first<4>());
  const std::size_t size = wire::load_le32(file.data.subspan<4, 4>());
  const std::size_t stride = records.fields.front().stride;
  if (size != records.count * stride) {
    throw file.error("its " + std::to_string(records.count) + " points have " +
                     std::to_string(records.count * stride) + " bytes, and its compressed data " +
                     std::to_string(size));
  }
  Bytes bytes = unpacked(file.data.subspan(8).first(std::min(packed, file.data.size() - 8)), size);
  if (bytes.size() != size) {
    throw file.error("its compressed points are damaged");
  }
  for (CloudField& field : records.fields) {
    field.at *= records.count;
    field.stride = field.bytes;
  }
  return bytes;
}

}  // namespace

SeenCloud read_pcd(const std::string& path, TimeUnit& unit, std::uint64_t stamp_us) {
  const Bytes bytes = read_cloud_file(path);
  const PcdFile file = file_of(path, bytes);
  CloudRecords records{.bytes = file.data, .stamp_us = stamp_us};
  add_fields(file, records);
  records.count = file.number(file.words("POINTS")[0]);
  check_count(records, path);
  if (file.head.contains("WIDTH") && file.head.contains("HEIGHT")) {
    const std::size_t width = file.number(file.words("WIDTH")[0]);
    const std::size_t height = file.number(file.words("HEIGHT")[0]);
    if (width * height != records.count) {
      throw file.error("WIDTH x HEIGHT is " + std::to_string(width * height) + ", and POINTS " +
                       std::to_string(records.count));
    }
  }
  const std::string& data = file.words("DATA")[0];
  Bytes made;
  if (data == "ascii") {
    made = rows_of(file, records);
    records.bytes = made;
  } else if (data == "binary_compressed") {
    made = columns_of(file, records);
    records.bytes = made;
  } else if (data == "binary") {
    if (file.data.size() >= (records.count + 1) * records.fields.front().stride) {
      throw file.error("it has more bytes than its " + std::to_string(records.count) + " points");
    }
  } else {
    throw file.error("DATA is " + data + "; use ascii, binary, binary_compressed");
  }
  SeenCloud cloud = cloud_of(records, unit, path);
  cloud.viewpoint = viewpoint_of(file);
  return cloud;
}

}  // namespace iog::tools
