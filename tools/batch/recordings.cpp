#include "tools/batch/recordings.hpp"

#include <algorithm>
#include <array>
#include <filesystem>
#include <map>
#include <set>
#include <system_error>
#include <utility>

#include "tools/program/exit_status.hpp"
#include "tools/program/file.hpp"
#include "tools/program/joined.hpp"
#include "tools/program/letter_case.hpp"

namespace iog::tools {
namespace {

namespace files = std::filesystem;

std::string ending_of(const files::path& path) { return in_lower_case(path.extension().string()); }

// Without the ending of a packer: "drive.pcap" for "drive.pcap.gz".
files::path unpacked(const files::path& path) {
  const std::string ending = ending_of(path);
  return ending == ".gz" || ending == ".zst" ? path.parent_path() / path.stem() : path;
}

bool is_capture(const files::path& path) {
  const bool is_of_macos = path.filename().string().starts_with("._");  // what it knows of a file
  const std::string ending = ending_of(unpacked(path));
  return !is_of_macos && (ending == ".pcap" || ending == ".pcapng");
}

// "drive.poses.csv" or "drive.POSES.CSV" for "drive.pcap.gz"; a folder is "drive.poses".
std::vector<std::string> poses_beside(const files::path& capture) {
  constexpr std::array kEndings{"", ".csv", ".nmea", ".ubx", ".txt", ".tum", ".mcap", ".db3"};
  std::vector<std::string> found;
  const std::string stem = unpacked(capture).replace_extension().string();
  for (const std::string ending : kEndings) {
    const std::array<std::string, 3> written{".poses" + ending, ".poses" + in_capitals(ending),
                                             ".POSES" + in_capitals(ending)};
    for (const std::string& behind : written) {
      std::error_code error;
      const std::string log = stem + behind;
      const auto is_same = [&](const std::string& other) {
        return files::equivalent(log, other, error);
      };
      // A broken link counts as a log, too: reading it fails.
      if (files::exists(files::symlink_status(log, error)) &&
          std::ranges::none_of(found, is_same)) {
        found.push_back(log);
      }
    }
  }
  return found;
}

ListedCapture recording_of(const std::string& name, const files::path& path) {
  const files::path place = files::absolute(path).lexically_normal();
  std::error_code error;
  const auto bytes = files::is_regular_file(place, error) ? files::file_size(place, error) : 0;
  const std::vector<std::string> logs = poses_beside(place);
  return {.name = name,
          .path = place.string(),
          .poses = logs.empty() ? "" : logs.front(),
          .bytes = error ? 0 : bytes,
          .refusal = logs.size() < 2
                         ? ""
                         : std::to_string(logs.size()) +
                               " pose logs found; keep only one: " + joined(logs, ", ")};
}

// A link to nothing, or to itself.
bool is_broken_link(const files::directory_entry& entry) {
  std::error_code error;
  return entry.is_symlink(error) && !entry.exists(error);
}

// Adds the captures in a folder and below it, by their canonical folder and name. Links to folders
// are followed, except to a folder that contains them. Of a folder's paths the first by name is
// used.
void add_captures(const files::path& folder, const files::path& top, std::set<files::path>& around,
                  std::map<files::path, ListedCapture>& found) {
  std::error_code error;
  const files::path real = files::canonical(folder, error);
  if (error || !around.insert(real).second) {
    return;
  }
  std::set<files::path> inside;
  for (files::directory_iterator next(folder, error), end; !error && next != end;
       next.increment(error)) {
    inside.insert(next->path());
  }
  if (error) {
    throw UsageError(folder.string() + ": cannot be listed: " + error.message());
  }
  for (const files::path& path : inside) {
    const files::directory_entry entry(path, error);
    if (entry.is_directory(error)) {
      add_captures(path, top, around, found);
    } else if (is_capture(path) && (is_broken_link(entry) || entry.is_regular_file(error))) {
      found.try_emplace(real / path.filename(),
                        recording_of(path.lexically_relative(top).string(), path));
    }
  }
  around.erase(real);
}

std::vector<ListedCapture> in_folder(const files::path& folder) {
  std::set<files::path> around;
  std::map<files::path, ListedCapture> found;
  add_captures(folder, folder, around, found);
  std::vector<ListedCapture> captures;
  for (auto& [place, its] : found) {
    captures.push_back(std::move(its));
  }
  return captures;
}

std::vector<ListedCapture> in_list(const std::string& list) {
  std::vector<ListedCapture> found;
  std::set<std::string> paths;
  for (std::string name : read_lines(list)) {
    name.erase(name.find_last_not_of('\r') + 1);
    if (name.find('\0') != std::string::npos) {
      throw UsageError(list + ": a list of recordings is a text file with one path on each line");
    }
    if (name.empty()) {
      continue;
    }
    ListedCapture recording = recording_of(name, files::path(list).parent_path() / name);
    if (paths.insert(recording.path).second) {
      found.push_back(std::move(recording));
    }
  }
  return found;
}

}  // namespace

std::vector<ListedCapture> recordings_of(const std::string& folder_or_list) {
  const bool is_folder = files::is_directory(folder_or_list);
  std::vector<ListedCapture> found =
      is_folder ? in_folder(folder_or_list) : in_list(folder_or_list);
  if (found.empty()) {
    throw UsageError(folder_or_list + (is_folder ? ": no capture (.pcap, .pcapng; also .gz or .zst)"
                                                 : ": this list names no recording"));
  }
  std::ranges::sort(found, [](const ListedCapture& a, const ListedCapture& b) {
    return a.bytes != b.bytes ? a.bytes > b.bytes : a.name < b.name;
  });
  return found;
}

}  // namespace iog::tools
