#include "tools/formats/ros/sqlite_bag.hpp"

#include <filesystem>
#include <map>
#include <memory>
#include <sqlite3.h>

#include "tools/program/exit_status.hpp"

namespace iog::tools::ros {
namespace {

struct Close {
  void operator()(sqlite3* file) const { sqlite3_close(file); }
  void operator()(sqlite3_stmt* query) const { sqlite3_finalize(query); }
};

class Bag {
 public:
  Bag(const std::string& path, const std::string& what) : what_(&what) {
    if (std::filesystem::exists(path + "-wal") && std::filesystem::file_size(path + "-wal") > 0) {
      throw UsageError(what + ": its last messages are still in " + what +
                       "-wal: run `sqlite3 FILE 'PRAGMA wal_checkpoint'` first");
    }
    sqlite3* file = nullptr;
    const int status = sqlite3_open_v2(address_of(path).c_str(), &file,
                                       SQLITE_OPEN_READONLY | SQLITE_OPEN_URI, nullptr);
    file_.reset(file);
    if (status != SQLITE_OK) {
      throw error();
    }
  }

  using Query = std::unique_ptr<sqlite3_stmt, Close>;
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

std::string text_of(const Bag::Query& query, int column) {
  const auto* const text = reinterpret_cast<const char*>(sqlite3_column_text(query.get(), column));
  return text == nullptr ? "" : text;
}

}  // namespace

std::vector<BagTopic> topics_in_sqlite(const std::string& path, const std::string& what) {
  const Bag bag(path, what);
  const Bag::Query query = bag.query(
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

void for_each_in_sqlite(
    const std::string& path, const std::string& what,
    const std::function<bool(const BagTopic&)>& wants,
    const std::function<void(const BagTopic&, std::span<const std::byte>)>& take) {
  const Bag bag(path, what);
  std::map<std::int64_t, BagTopic> wanted;
  const Bag::Query topics = bag.query("SELECT name, type, serialization_format, id FROM topics");
  while (bag.step(topics)) {
    BagTopic topic{text_of(topics, 0), text_of(topics, 1), text_of(topics, 2), 0};
    if (wants(topic)) {
      wanted.insert_or_assign(sqlite3_column_int64(topics.get(), 3), std::move(topic));
    }
  }
  // In the order of their numbers, which needs no index and no memory. SQLite reads no data that is
  // not asked for.
  const Bag::Query messages = bag.query("SELECT topic_id, data FROM messages ORDER BY id");
  while (bag.step(messages)) {
    const auto topic = wanted.find(sqlite3_column_int64(messages.get(), 0));
    if (topic != wanted.end()) {
      const auto* const data =
          static_cast<const std::byte*>(sqlite3_column_blob(messages.get(), 1));
      const int bytes = sqlite3_column_bytes(messages.get(), 1);
      take(topic->second, {data, static_cast<std::size_t>(bytes)});
    }
  }
}

}  // namespace iog::tools::ros
