// Ctrl-C and a plain kill end long work in good order: what has been done is still reported.
#pragma once

#include <memory>
#include <string>

namespace iog::tools {

// From now on SIGINT and SIGTERM are only remembered, and interrupt waiting system calls. A reader
// of our output who has gone away does not end us either.
void catch_interrupts();

[[nodiscard]] bool was_interrupted();

// A file of this program that goes with the object unless keep() was called before. It also goes
// if SIGINT, SIGTERM or SIGHUP ends the program.
class UnfinishedFile {
 public:
  UnfinishedFile() = default;  // none
  explicit UnfinishedFile(const std::string& path);

  [[nodiscard]] bool is_none() const { return path_ == nullptr; }
  [[nodiscard]] const std::string& path() const { return *path_; }
  // To make its name in place (mkstemp), so that no signal comes between.
  [[nodiscard]] char* letters() { return path_->data(); }
  void keep();

 private:
  struct Remover {
    void operator()(std::string* path) const;
  };

  std::unique_ptr<std::string, Remover> path_;
};

}  // namespace iog::tools
