#include "tools/program/file.hpp"

#include <algorithm>
#include <cerrno>
#include <cstdio>
#include <system_error>

namespace iog::tools {
namespace {

std::ifstream opened(const std::string& path) {
  errno = 0;
  std::ifstream stream(path, std::ios::binary);
  if (!stream) {
    throw file_error(path, "cannot be read");
  }
  if (std::filesystem::is_directory(path)) {
    throw UsageError(path + ": cannot be read: it is a folder");
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

UsageError file_error(const std::string& path, std::string_view what) {
  const int error = errno;
  std::string text = path + ": " + std::string(what);
  if (error != 0) {
    text += ": " + std::generic_category().message(error);
  }
  return UsageError(text);
}

UsageError empty_file(const std::string& path) {
  return UsageError(path + (std::filesystem::is_fifo(path)
                                ? ": this pipe is empty, or was read before; give a file"
                                : ": empty"));
}

std::vector<std::byte> read_file(const std::string& path) {
  std::ifstream stream = opened(path);
  // A pipe has no size.
  std::error_code has_no_size;
  const std::uintmax_t size = std::filesystem::file_size(path, has_no_size);
  constexpr std::size_t kChunk = 1U << 16;
  std::vector<std::byte> bytes(has_no_size ? kChunk : size + 1);
  std::size_t count = 0;
  errno = 0;
  while (stream) {
    bytes.resize(std::max(bytes.size(), count + kChunk));
    stream.read(reinterpret_cast<char*>(bytes.data() + count),
                static_cast<std::streamsize>(bytes.size() - count));
    count += static_cast<std::size_t>(stream.gcount());
  }
  if (stream.bad() || (!has_no_size && count < size)) {
    throw file_error(path, "cannot be read to its end");
  }
  bytes.resize(count);
  return bytes;
}

std::vector<std::string> read_lines(const std::string& path) {
  std::ifstream stream = opened(path);
  std::vector<std::string> lines;
  for (std::string line; std::getline(stream, line);) {
    lines.push_back(line);
  }
  if (!lines.empty() && lines.front().starts_with("\xEF\xBB\xBF")) {
    lines.front().erase(0, 3);
  }
  return lines;
}

std::size_t files_beside(const std::string& folder, std::string_view suffix, std::size_t known) {
  std::error_code error;
  const std::filesystem::directory_iterator entries(folder, error);
  const auto files = std::count_if(begin(entries), end(entries), [&](const auto& its) {
    return its.path().string().ends_with(suffix);
  });
  return std::max(static_cast<std::size_t>(files), known) - known;
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

std::vector<std::filesystem::path> numbered_files(const std::string& folder, std::string_view stem,
                                                  std::string_view suffix) {
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
  return found;
}

OutputPlace::OutputPlace(const std::string& path) : path_(path) {
  std::error_code error;
  if (path != "-" &&
      (std::filesystem::is_regular_file(path, error) || !std::filesystem::exists(path, error))) {
    const auto target = std::filesystem::weakly_canonical(path, error);  // behind links
    part_ = UnfinishedFile(target.string() + ".part");
  }
}

void OutputPlace::finish() {
  if (part_.is_none()) {
    return;
  }
  const std::string& part = part_.path();
  errno = 0;
  if (std::rename(part.c_str(), part.substr(0, part.rfind(".part")).c_str()) != 0) {
    throw file_error(path_, "cannot be written");
  }
  part_.keep();
}

OutputFile::OutputFile(const std::string& path) : path_(path), place_(path) {
  open(place_->path());
}

OutputFile::OutputFile(const UnfinishedFile& file) : path_(file.path()) { open(path_); }

void OutputFile::open(const std::string& path) {
  errno = 0;
  stream_.open(path, std::ios::binary);
  if (!stream_) {
    throw file_error(path_, "cannot be written");
  }
}

void OutputFile::write(std::span<const std::byte> bytes) {
  errno = 0;
  stream_.write(reinterpret_cast<const char*>(bytes.data()),
                static_cast<std::streamsize>(bytes.size()));
  if (!stream_) {
    throw file_error(path_, "cannot be written any more");
  }
}

void OutputFile::write(std::string_view text) { write(std::as_bytes(std::span(text))); }

void OutputFile::finish() {
  errno = 0;
  stream_.close();
  if (!stream_) {
    throw file_error(path_, "not written completely");
  }
  if (place_) {
    place_->finish();
  }
}

}  // namespace iog::tools
