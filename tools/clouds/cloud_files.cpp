#include "tools/clouds/cloud_files.hpp"

#include <algorithm>
#include <array>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <limits>
#include <map>
#include <set>
#include <span>
#include <sstream>
#include <string_view>
#include <utility>

#include "tools/clouds/cloud_set.hpp"
#include "tools/clouds/pcd_file.hpp"
#include "tools/clouds/ply_file.hpp"
#include "tools/formats/capture/file_hint.hpp"
#include "tools/formats/capture/made_capture.hpp"
#include "tools/program/exit_status.hpp"
#include "tools/program/letter_case.hpp"
#include "tools/program/middle.hpp"
#include "tools/program/natural_order.hpp"
#include "tools/program/printable.hpp"
#include "tools/program/table.hpp"

namespace iog::tools {
namespace {

constexpr std::array<std::string_view, 3> kEndings{".bin", ".pcd", ".ply"};
constexpr std::string_view kDigits = "0123456789";

// One of kEndings, whatever its case.
std::string_view ending_of(std::string_view path) {
  const std::string lower = in_lower_case(std::string(path.substr(path.find_last_of('/') + 1)));
  const auto found =
      std::ranges::find_if(kEndings, [&](auto ending) { return lower.ends_with(ending); });
  return found == kEndings.end() ? std::string_view{} : *found;
}

// "1532402927647951" of a file of nuScenes, n015-2018-07-24__LIDAR_TOP__1532402927647951.pcd.bin.
std::string_view without_ending(std::string_view path) {
  for (std::string_view ending = ending_of(path); !ending.empty(); ending = ending_of(path)) {
    path.remove_suffix(ending.size());
  }
  return path;
}

constexpr std::size_t kDigitsOfNanoseconds = 9;

// Whether digits behind the seconds in a name are nanoseconds. Fewer than 7, or leading zeros, may
// be a cloud's number. With may_be_short, fewer digits are nanoseconds, too.
bool are_nanoseconds(std::string_view digits, bool may_be_short) {
  const std::size_t fewest = may_be_short ? 1 : 7;
  return digits.size() == kDigitsOfNanoseconds || (may_be_short && digits == "0") ||
         (fewest <= digits.size() && digits.size() < kDigitsOfNanoseconds && digits[0] != '0');
}

std::uint64_t digits_as_number(std::string_view digits) {
  std::uint64_t number = 0;
  for (const char digit : digits) {
    number = 10 * number + static_cast<std::uint64_t>(digit - '0');
  }
  return number;
}

// Why a file is not read.
std::string words_of_other(const std::string& path) {
  const std::filesystem::path its(path);
  if (!std::filesystem::exists(its)) {
    return "there is no such file";
  }
  if (its.filename() == "metadata.yaml") {
    return "give the folder of the bag instead";
  }
  std::array<char, 1208> begin{};
  std::ifstream file(path, std::ios::binary);
  file.read(begin.data(), begin.size());
  const auto bytes = std::as_bytes(std::span(begin)).first(static_cast<std::size_t>(file.gcount()));
  const std::string hint = hint_of(bytes);
  return (hint.empty() ? "" : hint + "; ") +
         "use .mcap, .db3, .pcd, .ply, KITTI's .bin, nuScenes' .pcd.bin, and folders of a "
         "bag, of such files or of KITTI";
}

// "000007" and what is before it in its path.
std::pair<std::string_view, std::string_view> number_of(std::string_view path) {
  const std::string_view stem = without_ending(path);
  const std::size_t behind = stem.find_last_of(kDigits) + 1;  // 0 if there is no digit
  const std::size_t begin = stem.substr(0, behind).find_last_not_of(kDigits) + 1;
  return {stem.substr(begin, behind - begin), stem.substr(0, begin)};
}

// Whether most names are seconds_nanoseconds, so that a short last number is nanoseconds as well.
bool have_nanoseconds(const std::vector<std::string>& paths) {
  const auto count = std::ranges::count_if(paths, [](const std::string& path) {
    const auto [digits, head] = number_of(path);
    return head.ends_with('_') && are_nanoseconds(digits, false) && time_in_name(path);
  });
  return 2 * count > std::ssize(paths);
}

constexpr std::size_t kMostDigits = 18;  // of a number in a name, so that it fits into 64 bits

// Files whose names differ only in their last numbers, as front_000.pcd and front_001.pcd.
struct Series {
  std::string first_name;
  std::uint64_t least = std::numeric_limits<std::uint64_t>::max();  // number or time
  std::uint64_t most = 0;

  // A name without a number counts for nothing.
  void add(const std::string& name, bool may_be_short) {
    const std::string_view digits = number_of(name).first.substr(0, kMostDigits);
    if (digits.empty()) {
      return;
    }
    const std::uint64_t number =
        time_in_name(name, may_be_short).value_or(digits_as_number(digits));
    least = std::min(least, number);
    most = std::max(most, number);
  }
  [[nodiscard]] bool overlaps(const Series& other) const {
    return least <= other.most && other.least <= most;
  }
};

// The name with # instead of each number. If `are_units`, the first one of two numbers stays if it
// is short and belongs to a word, as in lidar1_000.pcd. A decimal point is a part of a number.
// Empty: no number.
std::string series_of(std::string_view name, bool are_units) {
  constexpr std::size_t kDigitsOfUnit = 2;
  const std::string_view stem = without_ending(name);
  const auto is_digit = [](char letter) { return '0' <= letter && letter <= '9'; };
  std::string series;
  std::vector<std::string_view> numbers;
  bool follows_word = false;
  for (std::size_t at = 0; at < stem.size();) {
    if (!is_digit(stem[at])) {
      series += stem[at++];
      continue;
    }
    std::size_t end = at;
    while (end < stem.size() &&
           (is_digit(stem[end]) ||
            (stem[end] == '.' && end + 1 < stem.size() && is_digit(stem[end + 1])))) {
      ++end;
    }
    const std::string_view before = series;
    const std::size_t last = before.find_last_not_of("_-");
    follows_word |= numbers.empty() && last != std::string_view::npos;
    numbers.push_back(stem.substr(at, end - at));
    series += '#';
    at = end;
  }
  if (are_units && numbers.size() == 2 && follows_word && numbers[0].size() <= kDigitsOfUnit) {
    series.replace(series.find('#'), 1, numbers[0]);
  }
  return numbers.empty() ? std::string() : series;
}

// What is wrong if files of one folder are those of several lidars or drives, or copies: names of
// few series whose numbers overlap. are_units: as of series_of(). Empty: nothing.
std::string words_of_several(const std::vector<std::string>& paths, bool are_units) {
  std::map<std::pair<std::string, std::string>, Series> all;  // by folder and series
  const bool may_be_short = have_nanoseconds(paths);
  for (const std::string& path : paths) {
    const std::filesystem::path its(path);
    const std::string name = its.filename();
    const std::string series = series_of(name, are_units);
    if (series.empty()) {
      continue;
    }
    Series& of_name = all[{its.parent_path(), series}];
    of_name.first_name = of_name.first_name.empty() ? name : of_name.first_name;
    of_name.add(name, may_be_short);
  }
  if (2 * all.size() > paths.size()) {  // names without an order
    return {};
  }
  for (auto one = all.begin(); one != all.end(); ++one) {
    const auto other = std::find_if(std::next(one), all.end(), [&](const auto& its) {
      return its.first.first == one->first.first && its.second.overlaps(one->second);
    });
    if (other != all.end()) {
      return printable(one->second.first_name) + " and " + printable(other->second.first_name) +
             " seem to be of two lidars or drives, or copies; give the files of one";
    }
  }
  return {};
}

// Returns the key that orders the files of a drive: the time in the name, or its numbers. Words
// before the first number do not count. Empty: there is none.
std::string key_of(const std::string& path, bool may_be_short) {
  if (const std::optional<std::uint64_t> time_us = time_in_name(path, may_be_short)) {
    return natural_key(std::to_string(*time_us)).first;
  }
  const std::string name = std::filesystem::path(path).filename();
  const std::string_view stem = without_ending(name);
  return natural_key(stem.substr(std::min(stem.size(), stem.find_first_of(kDigits)))).first;
}

// How far the number of the file is behind that of the one before; 0: not known.
std::uint64_t step_between(const CloudFile& before, const CloudFile& file) {
  const auto [from, from_head] = number_of(before.path);
  const auto [to, to_head] = number_of(file.path);
  const bool are_known = !from.empty() && from.size() <= kMostDigits && !to.empty() &&
                         to.size() <= kMostDigits && from_head == to_head;
  return are_known ? digits_as_number(to) - digits_as_number(from) : 0;
}

// If most numbers advance by one step, how many files are missing; empty: none.
std::string words_of_missing(const std::vector<CloudFile>& files) {
  std::vector<std::uint64_t> steps;  // known ones
  for (std::size_t i = 1; i < files.size(); ++i) {
    if (const std::uint64_t step = step_between(files[i - 1], files[i]); step > 0) {
      steps.push_back(step);
    }
  }
  if (steps.empty()) {
    return {};
  }
  const std::uint64_t usual = middle_value_of(steps);
  if (2 * std::ranges::count(steps, usual) <= std::ssize(steps)) {
    return {};
  }
  std::uint64_t missing = 0;
  std::string first;
  for (std::size_t i = 1; i < files.size(); ++i) {
    const std::uint64_t its = (step_between(files[i - 1], files[i]) + usual / 4) / usual;
    if (its > 1) {
      missing += its - 1;
      first = first.empty() ? std::filesystem::path(files[i - 1].path).filename().string() : first;
    }
  }
  return missing == 0 ? ""
                      : counted(missing, "file|files is|are missing") +
                            " by the numbers in their names, the first after " + printable(first) +
                            ": clouds after it are timed too early";
}

SeenCloud read_with_stamp(const CloudFile& file, TimeUnit& unit) {
  const std::string_view ending = ending_of(file.path);
  if (ending == ".pcd") {
    return read_pcd(file.path, unit, file.time_us);
  }
  if (ending == ".ply") {
    return read_ply(file.path, unit, file.time_us);
  }
  if (ending == ".bin") {
    return read_kitti_cloud(file.path, file.time_us);
  }
  throw UsageError(file.path + ": " + words_of_other(file.path));
}

}  // namespace

bool is_cloud_file(const std::string& path) { return !ending_of(path).empty(); }

std::vector<std::string> cloud_files_in(const std::string& folder) {
  std::vector<std::string> paths;
  std::set<std::string_view> endings;
  for (const std::filesystem::directory_entry& entry :
       std::filesystem::directory_iterator(folder)) {
    const std::string path = entry.path();
    const bool is_hidden = entry.path().filename().string().starts_with('.');  // "._1.pcd" of macOS
    if (is_cloud_file(path) && !is_hidden && !entry.is_directory() && !entry.is_other()) {
      endings.insert(ending_of(path));
      paths.push_back(path);
    }
  }
  if (endings.size() > 1) {
    throw UsageError(folder + ": it has files " + std::string(*endings.begin()) + " and " +
                     std::string(*endings.rbegin()) + "; give those of one drive, FOLDER/*" +
                     std::string(*endings.begin()));
  }
  std::ranges::sort(paths, {}, natural_key);
  if (const std::string several = words_of_several(paths, false); !several.empty()) {
    throw UsageError(folder + ": " + several);
  }
  return paths;
}

std::string words_of_overlap(const std::vector<std::vector<std::string>>& folders) {
  struct Range {
    std::string folder;
    std::string least{};
    std::string most{};
  };
  std::vector<Range> all;
  for (const std::vector<std::string>& files : folders) {
    Range its{.folder = std::filesystem::path(files.front()).parent_path()};
    const bool may_be_short = have_nanoseconds(files);
    for (const std::string& path : files) {
      const std::string key = key_of(path, may_be_short);
      const bool is_one_empty = its.least.empty() || key.empty();
      its.least = is_one_empty ? std::max(its.least, key) : std::min(its.least, key);
      its.most = std::max(its.most, key);
    }
    const auto other = std::ranges::find_if(all, [&](const Range& range) {
      return !its.most.empty() && range.least <= its.most && its.least <= range.most;
    });
    if (other != all.end()) {
      return "numbers or times in the file names of " + printable(other->folder) + " and " +
             printable(its.folder) +
             " overlap: if they are of two lidars, give each folder to a run of its own";
    }
    all.push_back(its);
  }
  return {};
}

std::optional<std::uint64_t> time_in_name(const std::string& path, bool may_be_short) {
  const std::string name = std::filesystem::path(path).filename();
  const std::string_view stem = without_ending(name);
  const std::size_t begin_of_last = stem.find_last_not_of(kDigits) + 1;  // 0 if all are digits
  std::string_view whole = stem.substr(begin_of_last);
  std::uint64_t fraction_us = 0;
  const char separator = begin_of_last > 1 ? stem[begin_of_last - 1] : ' ';
  if (separator == '.' ? !whole.empty()
                       : separator == '_' && are_nanoseconds(whole, may_be_short)) {
    std::string nanoseconds(whole.substr(0, kDigitsOfNanoseconds));
    nanoseconds.insert(separator == '.' ? nanoseconds.size() : 0,
                       kDigitsOfNanoseconds - nanoseconds.size(), '0');
    fraction_us = digits_as_number(nanoseconds) / 1'000;
    const std::string_view before = stem.substr(0, begin_of_last - 1);
    whole = before.substr(before.find_last_not_of(kDigits) + 1);
    if (whole.size() != 10) {
      return std::nullopt;
    }
  }
  const bool is_of_our_days = !whole.empty() && whole.front() >= '1' && whole.front() <= '3';
  if (!is_of_our_days) {
    return std::nullopt;
  }
  switch (whole.size()) {
    case 10:
      return digits_as_number(whole) * 1'000'000 + fraction_us;
    case 13:
      return digits_as_number(whole) * 1'000;
    case 16:
      return digits_as_number(whole);
    case 19:
      return digits_as_number(whole) / 1'000;
    default:
      return std::nullopt;
  }
}

CloudFiles timed(const std::vector<std::string>& paths, double clouds_per_second) {
  CloudFiles all;
  bool have_times = true;
  const bool may_be_short = have_nanoseconds(paths);
  for (const std::string& path : paths) {
    const std::optional<std::uint64_t> time_us = time_in_name(path, may_be_short);
    have_times = have_times && time_us.has_value();
    all.files.push_back({.path = path, .time_us = time_us.value_or(0)});
  }
  if (have_times) {
    std::ranges::stable_sort(all.files, {}, &CloudFile::time_us);
  } else {
    std::ranges::stable_sort(all.files, {},
                             [](const CloudFile& file) { return natural_key(file.path); });
  }
  if (!std::ranges::equal(all.files, paths, {}, &CloudFile::path)) {
    all.remarks.push_back(std::string("files were put in the order of the ") +
                          (have_times ? "times" : "numbers") + " in their names");
  }
  if (const std::string several = words_of_several(paths, true); !several.empty()) {
    all.remarks.push_back(several);
  }
  if (!have_times) {
    std::ostringstream words;
    words << "neither file names nor points have Unix times: " << clouds_per_second
          << " clouds per second assumed (--rate), from 2024-05-01 12:00:00 UTC";
    all.remarks_if_assumed.push_back(words.str());
    if (const std::string missing = words_of_missing(all.files); !missing.empty()) {
      all.remarks_if_assumed.push_back(missing);
    }
    for (std::size_t i = 0; i < all.files.size(); ++i) {
      const double us = 1e6 * static_cast<double>(i) / clouds_per_second;
      all.files[i].is_assumed = true;
      all.files[i].time_us = kDriveStartUs + static_cast<std::uint64_t>(us);
    }
  }
  return all;
}

SeenCloud read_cloud_of(const CloudFile& file, TimeUnit& unit) {
  SeenCloud cloud = read_with_stamp(file, unit);
  if (file.is_assumed) {
    cloud.is_assumed = cloud.since_1970_us == 0;
    cloud.time_us = cloud.is_assumed ? file.time_us : cloud.since_1970_us;
    cloud.apart_us = 0;
  }
  return cloud;
}

}  // namespace iog::tools
