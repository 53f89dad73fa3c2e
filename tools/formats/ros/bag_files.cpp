#include "tools/formats/ros/bag_files.hpp"

#include <algorithm>
#include <array>
#include <charconv>
#include <cstdint>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <optional>
#include <string_view>
#include <unistd.h>

#include "tools/formats/capture/unpacked_file.hpp"
#include "tools/program/exit_status.hpp"
#include "tools/program/file.hpp"
#include "tools/program/natural_order.hpp"
#include "tools/program/printable.hpp"
#include "tools/program/table.hpp"

namespace iog::tools::ros {
namespace {

namespace files = std::filesystem;

constexpr std::array<std::string_view, 6> kEndings{".mcap",     ".db3",      ".mcap.zstd",
                                                   ".db3.zstd", ".mcap.zst", ".db3.zst"};

bool is_file_of_bag(const std::string& path) {
  return std::ranges::any_of(kEndings, [&](auto ending) { return path.ends_with(ending); });
}

bool begins_as_mcap(const std::string& path) {
  std::error_code ignored;
  std::array<char, 8> magic{};
  return files::is_regular_file(path, ignored) &&  // a pipe can be read only once
         std::ifstream(path, std::ios::binary).read(magic.data(), magic.size()) &&
         std::string_view(magic.data(), magic.size()) == "\x89MCAP0\r\n";
}

std::vector<std::string> all_in(const std::string& folder) {
  std::vector<std::string> found;
  for (const files::directory_entry& entry : files::directory_iterator(folder)) {
    if (is_file_of_bag(entry.path()) && !entry.is_other()) {  // no device or pipe
      found.push_back(entry.path());
    }
  }
  std::ranges::sort(found, {}, natural_key);
  return found;
}

std::string value_in(std::string_view line) {
  const std::size_t begin = line.find_first_not_of(" -\"'");
  const std::size_t end = line.find_last_not_of(" \"'\r");
  return begin == std::string_view::npos ? "" : std::string(line.substr(begin, end + 1 - begin));
}

// The number of a file of a bag, as in NAME_3.db3.zst; nothing if there is none.
std::optional<std::uint64_t> number_of(const std::string& path) {
  const std::string name = files::path(path).filename();
  const auto ending = std::ranges::find_if(kEndings, [&](auto its) { return name.ends_with(its); });
  const std::string_view stem = std::string_view(name).substr(
      0, name.size() - (ending == kEndings.end() ? 0 : ending->size()));
  const std::string_view digits = stem.substr(stem.find_last_not_of("0123456789") + 1);
  constexpr std::size_t kMostDigits = 9;  // longer ones are times
  std::uint64_t number = 0;
  std::from_chars(digits.data(), digits.data() + digits.size(), number);
  return digits.empty() || digits.size() > kMostDigits ? std::nullopt : std::optional(number);
}

// Of a folder without metadata.yaml; empty if no number is left out.
std::string words_of_missing(const std::vector<std::string>& names) {
  std::uint64_t missing = 0;
  std::string first;
  for (std::size_t i = 1; i < names.size(); ++i) {
    const auto before = number_of(names[i - 1]);
    const auto number = number_of(names[i]);
    if (before && number && *number > *before + 1) {
      missing += *number - *before - 1;
      first = first.empty() ? names[i - 1] : first;
    }
  }
  return missing == 0 ? ""
                      : counted(missing, "file|files is|are missing") +
                            " by the numbers in their names, the first after " + printable(first);
}

// Only what rosbag2 itself writes is understood, not all of YAML.
std::vector<std::string> of_metadata(const std::string& folder) {
  const std::string path = folder + "/metadata.yaml";
  constexpr std::uintmax_t kMostBytes = 16U << 20;
  if (files::file_size(path) > kMostBytes) {
    throw UsageError(path + ": larger than 16 MiB");
  }
  std::vector<std::string> found;
  bool is_in_list = false;
  for (const std::string& line : read_lines(path)) {
    const std::string_view text =
        std::string_view(line).substr(std::min(line.find_first_not_of(' '), line.size()));
    constexpr std::string_view kCompression = "compression_format:";
    if (text.starts_with(kCompression)) {
      const std::string format = value_in(text.substr(kCompression.size()));
      if (!format.empty() && format != "zstd") {
        throw UsageError(path + ": the bag is compressed by " + printable(format) +
                         "; only zstd is read");
      }
    }
    is_in_list = text.starts_with("relative_file_paths:") || (is_in_list && text.starts_with("-"));
    if (is_in_list && text.starts_with("-")) {
      found.push_back(folder + "/" + files::path(value_in(text)).filename().string());
      if (!files::exists(found.back())) {
        throw UsageError(found.back() + ": this part of the bag is not there");
      }
    }
  }
  if (found.empty()) {
    throw UsageError(path + ": it lists no file below relative_file_paths, one a line behind '-'");
  }
  return found;
}

}  // namespace

bool is_recording(const std::string& path) {
  if (!files::is_directory(path)) {
    return is_file_of_bag(path) || begins_as_mcap(path);
  }
  return files::exists(path + "/metadata.yaml") || !all_in(path).empty();
}

std::vector<std::string> files_of_recording(const std::string& path) {
  if (!files::is_directory(path)) {
    return {path};
  }
  std::vector<std::string> found =
      files::exists(path + "/metadata.yaml") ? of_metadata(path) : all_in(path);
  if (found.empty()) {
    throw UsageError(path + ": no file of a bag is in this folder: .db3, .mcap, or these as .zstd");
  }
  return found;
}

std::vector<std::string> remarks_on_files(const std::string& path) {
  std::vector<std::string> words;
  if (files::is_directory(path)) {
    const std::vector<std::string> read = files_of_recording(path);
    for (const std::string& name : all_in(path)) {
      const bool is_read = std::ranges::any_of(read, [&](const std::string& its) {
        std::error_code error;
        return files::equivalent(its, name, error);
      });
      if (!is_read) {
        words.push_back(printable(name) + ": metadata.yaml does not list this file; not read");
      }
    }
    if (const std::string missing = words_of_missing(read);
        !files::exists(path + "/metadata.yaml") && !missing.empty()) {
      words.push_back(printable(path) + ": " + missing);
    }
  }
  return words;
}

PlainFile::PlainFile(const std::string& path) : path_(path) {
  UnpackedFile packed(path);
  if (packed.packer().empty()) {
    return;
  }
  std::error_code error;
  const files::path folder = files::temp_directory_path(error);
  if (error) {
    throw UsageError(path +
                     ": it is unpacked into the folder for temporary files, and TMPDIR names none");
  }
  copy_ = UnfinishedFile(folder / "iog_bag_XXXXXX");
  const int made = mkstemp(copy_.letters());
  path_ = copy_.path();
  if (made < 0) {
    throw file_error(path_, "cannot be made");
  }
  close(made);
  OutputFile out(copy_);
  std::vector<std::byte> bytes(1U << 20);
  while (const std::size_t got = packed.read(bytes)) {
    out.write(std::span(bytes).first(got));
  }
  out.finish();
  if (!packed.trouble().empty()) {
    throw UsageError(path + ": " + packed.trouble());
  }
}

}  // namespace iog::tools::ros
