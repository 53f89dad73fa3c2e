// What a map was made of: how much was taken, how much of that by default, what was refused and
// why.
#pragma once

#include <cstdint>
#include <map>
#include <string>
#include <string_view>
#include <vector>

namespace iog::tools {

class Census {
 public:
  enum class Column : std::uint8_t { kTaken, kDefaulted, kRefused };

  // `id` is how the source calls the object, such as "way 17"; the first few of a reason are kept.
  void count(Column column, std::string_view reason, std::string_view id);

  void take(std::string_view what, std::string_view id) { count(Column::kTaken, what, id); }
  void assume(std::string_view why, std::string_view id) { count(Column::kDefaulted, why, id); }
  void refuse(std::string_view why, std::string_view id) { count(Column::kRefused, why, id); }

  [[nodiscard]] std::uint64_t of(Column column, std::string_view reason) const;
  [[nodiscard]] std::uint64_t sum(Column column) const;

  // "2 building without area, 1 ..."; empty if nothing was refused.
  [[nodiscard]] std::string words_of_refused() const;

  // A row for each reason.
  [[nodiscard]] std::string table() const;

 private:
  struct Entry {
    std::uint64_t number = 0;
    std::vector<std::string> first;
  };
  std::map<Column, std::map<std::string, Entry, std::less<>>> entries_;
};

}  // namespace iog::tools
