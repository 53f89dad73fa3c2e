#include "tools/program/file.hpp"

#include <algorithm>
#include <filesystem>
#include <system_error>

#include "tools/program/exit_status.hpp"

namespace iog::tools {
namespace {

std::ifstream opened(const std::string& path) {
  std::ifstream stream(path, std::ios::binary);
  if (!stream || std::filesystem::is_directory(path)) {
    throw UsageError(path + ": cannot be read");
  }
  return stream;
}

constexpr std::size_t kDigits = 6;  // at least

// Whether numbered() makes such a name.
bool is_numbered(std::string_view name, std::string_view stem, std::string_view suffix) {
  if (!name.starts_with(stem) || !name.ends_with(suffix) ||
      name.size() < stem.size() + 1 + kDigits + suffix.size() || name[stem.size()] != '_') {
    return false;
  }
  name.remove_prefix(stem.size() + 1);
  name.remove_suffix(suffix.size());
  return std::ranges::all_of(name, [](char letter) { return '0' <= letter && letter <= '9'; });
}

}  // namespace

std::vector<std::byte> read_file(const std::string& path) {
  std::ifstream stream = opened(path);
  std::vector<std::byte> bytes(std::filesystem::file_size(path));
  stream.read(reinterpret_cast<char*>(bytes.data()), static_cast<std::streamsize>(bytes.size()));
  if (!stream) {
    throw UsageError(path + ": cannot be read");
  }
  return bytes;
}

std::vector<std::string> read_lines(const std::string& path) {
  std::ifstream stream = opened(path);
  std::vector<std::string> lines;
  for (std::string line; std::getline(stream, line);) {
    lines.push_back(line);
  }
  return lines;
}

void make_folder(const std::string& path) {
  std::error_code error;
  std::filesystem::create_directories(path, error);
  if (error) {
    throw UsageError(path + ": cannot make this folder: " + error.message());
  }
}

std::string numbered(const std::string& folder, std::string_view stem, std::uint64_t number,
                     std::string_view suffix) {
  std::string digits = std::to_string(number);
  digits.insert(0, kDigits - std::min(kDigits, digits.size()), '0');
  std::string name = folder;
  name.append("/").append(stem).append("_").append(digits).append(suffix);
  return name;
}

void remove_numbered(const std::string& folder, std::string_view stem, std::string_view suffix) {
  std::error_code error;
  const std::filesystem::directory_iterator entries(folder, error);
  if (error) {
    throw UsageError(folder + ": cannot be listed: " + error.message());
  }
  std::vector<std::filesystem::path> found;
  for (const auto& entry : entries) {
    if (is_numbered(entry.path().filename().string(), stem, suffix)) {
      found.push_back(entry.path());
    }
  }
  for (const std::filesystem::path& path : found) {
    if (!std::filesystem::remove(path, error)) {
      throw UsageError(path.string() + ": cannot be removed: " + error.message());
    }
  }
}

OutputFile::OutputFile(const std::string& path) : path_(path), stream_(path, std::ios::binary) {
  if (!stream_) {
    throw UsageError(path + ": cannot be written");
  }
}

void OutputFile::write(std::span<const std::byte> bytes) {
  stream_.write(reinterpret_cast<const char*>(bytes.data()),
                static_cast<std::streamsize>(bytes.size()));
}

void OutputFile::write(std::string_view text) { write(std::as_bytes(std::span(text))); }

void OutputFile::finish() {
  stream_.close();
  if (!stream_) {
    throw UsageError(path_ + ": not written completely; is the disk full?");
  }
}

}  // namespace iog::tools
