// Whole files and folders, with one plain sentence when they cannot be read or written.
#pragma once

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <fstream>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "tools/program/exit_status.hpp"
#include "tools/program/interrupt.hpp"

namespace iog::tools {

// "path: what: why", why in the system's words for what it has just refused (errno).
[[nodiscard]] UsageError file_error(const std::string& path, std::string_view what);

// Says that the file is empty. A pipe may have been read before.
[[nodiscard]] UsageError empty_file(const std::string& path);

// UsageError if the file cannot be read.
[[nodiscard]] std::vector<std::byte> read_file(const std::string& path);
// Leaves out the byte order mark of UTF-8.
[[nodiscard]] std::vector<std::string> read_lines(const std::string& path);

// The number of files in a folder that have this suffix, minus the `known` ones.
[[nodiscard]] std::size_t files_beside(const std::string& folder, std::string_view suffix,
                                       std::size_t known);

// Makes the folder and those above it. UsageError if that is not possible.
void make_folder(const std::string& path);

// `folder`/`stem`_000123`suffix`
[[nodiscard]] std::string numbered(const std::string& folder, std::string_view stem,
                                   std::uint64_t number, std::string_view suffix);
// All paths of this folder that numbered() may have made.
[[nodiscard]] std::vector<std::filesystem::path> numbered_files(const std::string& folder,
                                                                std::string_view stem,
                                                                std::string_view suffix);

// The destination of an output. Bytes are written to PATH.part, which finish() renames to PATH.
// Without finish(), or if a signal ends the program, no output remains, and an existing file stays
// as it was. A recording may call finish() early, and goes on writing to PATH. Devices, pipes and
// "-" are written directly.
class OutputPlace {
 public:
  explicit OutputPlace(const std::string& path);

  [[nodiscard]] const std::string& path() const { return part_.is_none() ? path_ : part_.path(); }
  // UsageError if it cannot be renamed to PATH. A second call does nothing.
  void finish();

 private:
  std::string path_;
  UnfinishedFile part_;
};

class OutputFile {
 public:
  // UsageError if the file cannot be written.
  explicit OutputFile(const std::string& path);
  // Writes to an existing file, which its owner removes.
  explicit OutputFile(const UnfinishedFile& file);

  // UsageError if it is known already that the bytes do not reach the file.
  void write(std::span<const std::byte> bytes);
  void write(std::string_view text);

  // UsageError if not all has been written. Once, at the end.
  void finish();

 private:
  void open(const std::string& path);

  std::string path_;
  std::optional<OutputPlace> place_;
  std::ofstream stream_;
};

}  // namespace iog::tools
