#include "tools/map/census.hpp"

#include <iomanip>
#include <sstream>

namespace iog::tools {
namespace {

constexpr std::size_t kKeptIds = 3;

const char* name_of(Census::Column column) {
  switch (column) {
    case Census::Column::kTaken:
      return "taken";
    case Census::Column::kDefaulted:
      return "default";
    case Census::Column::kRefused:
      return "refused";
  }
  return "";
}

}  // namespace

void Census::count(Column column, std::string_view reason, std::string_view id) {
  auto& reasons = entries_[column];
  auto found = reasons.find(reason);
  if (found == reasons.end()) {
    found = reasons.emplace(reason, Entry{}).first;
  }
  ++found->second.number;
  if (column != Column::kTaken && found->second.first.size() < kKeptIds) {
    found->second.first.emplace_back(id);
  }
}

std::uint64_t Census::of(Column column, std::string_view reason) const {
  const auto reasons = entries_.find(column);
  if (reasons == entries_.end()) {
    return 0;
  }
  const auto found = reasons->second.find(reason);
  return found == reasons->second.end() ? 0 : found->second.number;
}

std::uint64_t Census::sum(Column column) const {
  std::uint64_t sum = 0;
  if (const auto reasons = entries_.find(column); reasons != entries_.end()) {
    for (const auto& [reason, entry] : reasons->second) {
      sum += entry.number;
    }
  }
  return sum;
}

std::string Census::words_of_refused() const {
  std::string words;
  if (const auto refused = entries_.find(Column::kRefused); refused != entries_.end()) {
    for (const auto& [reason, entry] : refused->second) {
      words += (words.empty() ? "" : ", ") + std::to_string(entry.number) + ' ' + reason;
    }
  }
  return words;
}

std::string Census::table() const {
  std::ostringstream text;
  for (const auto& [column, reasons] : entries_) {
    for (const auto& [reason, entry] : reasons) {
      text << std::left << std::setw(8) << name_of(column) << std::right << std::setw(9)
           << entry.number << "  " << reason;
      for (const std::string& id : entry.first) {
        text << (&id == entry.first.data() ? "  (" : ", ") << id;
      }
      const bool has_more = entry.number > entry.first.size();
      text << (entry.first.empty() ? "" : has_more ? ", ...)" : ")") << '\n';
    }
  }
  return text.str();
}

}  // namespace iog::tools
