// The files of the page, compiled into the program (tools/view/page).
#pragma once

#include <span>
#include <string_view>

namespace iog::tools::view {

struct PageFile {
  std::string_view path;  // "/view.js"
  std::string_view type;  // of its content, as HTTP says it
  std::string_view content;
};

[[nodiscard]] std::span<const PageFile> page_files();

// nullptr if there is none of that path; "/" is the page itself.
[[nodiscard]] const PageFile* page_file(std::string_view path);

}  // namespace iog::tools::view
