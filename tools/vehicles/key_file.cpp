#include "tools/vehicles/key_file.hpp"

#include <charconv>
#include <fstream>
#include <string_view>

#include "tools/program/exit_status.hpp"

namespace iog::tools {

authentication::Key read_key_file(const std::string& path) {
  std::ifstream file(path, std::ios::binary);
  std::string digits;
  std::string more;
  if (!(file >> digits)) {
    throw UsageError(path + ": no key in it, or no such file; `openssl rand -hex 16` makes one");
  }
  authentication::Key key{};
  bool is_key = digits.size() == 2 * key.size() && !(file >> more);
  for (std::size_t i = 0; is_key && i < key.size(); ++i) {
    const std::string_view two = std::string_view(digits).substr(2 * i, 2);
    unsigned byte = 0;
    const auto [end, error] = std::from_chars(two.data(), two.data() + two.size(), byte, 16);
    is_key = error == std::errc() && end == two.data() + two.size();
    key.at(i) = static_cast<std::byte>(byte);
  }
  if (!is_key || key == authentication::Key{}) {
    throw UsageError(path +
                     ": a key is 32 hexadecimal digits that are not all 0, and nothing else");
  }
  return key;
}

std::string warning_of_key_file(std::string_view car, const std::string& path) {
  try {
    if (!path.empty()) {
      static_cast<void>(read_key_file(path));
    }
  } catch (const UsageError& error) {
    return "warning: " + std::string(car) + ": key_file " + error.what() + '\n';
  }
  return {};
}

}  // namespace iog::tools
