#include "tools/view/page_files.hpp"

#include <algorithm>

namespace iog::tools::view {

const PageFile* page_file(std::string_view path) {
  const std::string_view wanted = path == "/" ? "/view.html" : path;
  const auto files = page_files();
  const auto found = std::ranges::find(files, wanted, &PageFile::path);
  return found == files.end() ? nullptr : &*found;
}

}  // namespace iog::tools::view
