// Good inputs of fuzz targets, a file each.
#pragma once

#include <cstddef>
#include <filesystem>
#include <fstream>
#include <string>
#include <utility>
#include <vector>

namespace iog::fuzz {

using Bytes = std::vector<std::byte>;

class Seeds {
 public:
  explicit Seeds(std::filesystem::path root) : root_{std::move(root)} {}

  [[nodiscard]] std::string next_path(const std::string& target) {
    const std::filesystem::path folder = root_ / target;
    std::filesystem::create_directories(folder);
    return folder / std::to_string(count_++);
  }

  void add(const std::string& target, const Bytes& bytes) {
    std::ofstream file(next_path(target), std::ios::binary);
    file.write(reinterpret_cast<const char*>(bytes.data()),
               static_cast<std::streamsize>(bytes.size()));
  }

 private:
  std::filesystem::path root_;
  int count_ = 0;
};

inline Bytes piece_of(const Bytes& bytes) {
  Bytes piece{static_cast<std::byte>(bytes.size() >> 8), static_cast<std::byte>(bytes.size())};
  piece.insert(piece.end(), bytes.begin(), bytes.end());
  return piece;
}

inline Bytes joined(Bytes first, const Bytes& second) {
  first.insert(first.end(), second.begin(), second.end());
  return first;
}

// Messages of the stream (stream_seeds.cpp).
void add_stream_seeds(Seeds& seeds);

}  // namespace iog::fuzz
