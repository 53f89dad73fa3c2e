#include "tools/formats/ros/sqlite_bag.hpp"

#include <filesystem>
#include <fstream>
#include <map>
#include <memory>
#include <optional>
#include <sqlite3.h>

#include "tools/program/exit_status.hpp"

namespace iog::tools::ros {
namespace {

struct Close {
  void operator()(sqlite3* file) const { sqlite3_close(file); }
  void operator()(sqlite3_stmt* query) const { sqlite3_finalize(query); }
};

constexpr int kMostBytes = 256 << 20;  // of a message, as in MCAP

using Query = std::unique_ptr<sqlite3_stmt, Close>;

std::string text_of(const Query& query, int column) {
  const auto* const text = reinterpret_cast<const char*>(sqlite3_column_text(query.get(), column));
  return text == nullptr ? "" : text;
}

class Bag {
 public:
  Bag(const std::string& path, const std::string& what) : what_(&what) {
    if (std::filesystem::exists(path + "-wal") && std::filesystem::file_size(path + "-wal") > 0) {
      throw UsageError(what + ": its last messages are still in " + what +
                       "-wal: run `sqlite3 FILE 'PRAGMA wal_checkpoint'` first");
    }
    // The first byte of a journal that is over is zero.
    if (std::ifstream(path + "-journal", std::ios::binary).get() > 0) {
      throw UsageError(what + ": its writer was stopped; what it has changed is in " + what +
                       "-journal: run `sqlite3 FILE 'PRAGMA integrity_check'` first");
    }
    sqlite3* file = nullptr;
    const int status = sqlite3_open_v2(address_of(path).c_str(), &file,
                                       SQLITE_OPEN_READONLY | SQLITE_OPEN_URI, nullptr);
    file_.reset(file);
    if (status != SQLITE_OK) {
      throw error();
    }
    sqlite3_limit(file, SQLITE_LIMIT_LENGTH, kMostBytes);
    // A view may never end, or make what no file holds.
    const Query tables = query(
        "SELECT name FROM sqlite_master WHERE type != 'table' AND lower(name) IN "
        "('topics', 'messages')");
    if (step(tables)) {
      throw UsageError(what + ": it cannot be read as a bag of ROS 2: " + text_of(tables, 0) +
                       " is no table");
    }
  }

  [[nodiscard]] Query query(const char* words) const {
    sqlite3_stmt* made = nullptr;
    if (sqlite3_prepare_v2(file_.get(), words, -1, &made, nullptr) != SQLITE_OK) {
      throw error();
    }
    return Query(made);
  }
  // Whether there is another row.
  [[nodiscard]] bool step(const Query& query) const {
    const int status = sqlite3_step(query.get());
    if (status != SQLITE_ROW && status != SQLITE_DONE) {
      throw error();
    }
    return status == SQLITE_ROW;
  }

 private:
  // Immutable: SQLite takes no locks and writes no files beside it, so a bag may be on a medium
  // that cannot be written.
  static std::string address_of(const std::string& path) {
    std::string address = "file:";
    for (const char letter : std::filesystem::absolute(path).string()) {
      address += letter == '%'   ? "%25"
                 : letter == '?' ? "%3f"
                 : letter == '#' ? "%23"
                                 : std::string(1, letter);
    }
    return address + "?immutable=1";
  }
  [[nodiscard]] UsageError error() const {
    return UsageError(*what_ +
                      ": it cannot be read as a bag of ROS 2: " + sqlite3_errmsg(file_.get()));
  }

  const std::string* what_;
  std::unique_ptr<sqlite3, Close> file_;
};

}  // namespace

std::vector<BagTopic> topics_in_sqlite(const std::string& path, const std::string& what) {
  const Bag bag(path, what);
  const Query query = bag.query(
      "SELECT name, type, serialization_format, count(messages.id), max(timestamp) - "
      "min(timestamp) FROM topics LEFT JOIN messages ON topic_id = topics.id GROUP BY topics.id "
      "ORDER BY name");
  std::vector<BagTopic> topics;
  while (bag.step(query)) {
    topics.push_back({text_of(query, 0), text_of(query, 1), text_of(query, 2),
                      static_cast<std::uint64_t>(sqlite3_column_int64(query.get(), 3)),
                      static_cast<std::uint64_t>(sqlite3_column_int64(query.get(), 4))});
  }
  return topics;
}

std::uint64_t for_each_in_sqlite(
    const std::string& path, const std::string& what,
    const std::function<bool(const BagTopic&)>& wants,
    const std::function<void(const BagTopic&, std::span<const std::byte>)>& take) {
  const Bag bag(path, what);
  std::map<std::int64_t, std::optional<BagTopic>> known;  // nothing where it is not wanted
  const Query topics = bag.query("SELECT name, type, serialization_format, id FROM topics");
  while (bag.step(topics)) {
    BagTopic topic{text_of(topics, 0), text_of(topics, 1), text_of(topics, 2), 0};
    std::optional<BagTopic>& its = known[sqlite3_column_int64(topics.get(), 3)];
    if (wants(topic)) {
      its = std::move(topic);
    }
  }
  // In the order of their numbers, which needs no index and no memory. SQLite reads no data that is
  // not asked for.
  const Query messages = bag.query("SELECT topic_id, data FROM messages ORDER BY id");
  std::uint64_t lost = 0;
  while (bag.step(messages)) {
    const auto topic = known.find(sqlite3_column_int64(messages.get(), 0));
    if (topic == known.end()) {
      ++lost;
    } else if (topic->second) {
      const auto* const data =
          static_cast<const std::byte*>(sqlite3_column_blob(messages.get(), 1));
      const int bytes = sqlite3_column_bytes(messages.get(), 1);
      take(*topic->second, {data, static_cast<std::size_t>(bytes)});
    }
  }
  return lost;
}

}  // namespace iog::tools::ros
