#include <nlohmann/json.hpp>
#include <optional>
#include <string>

#include "gtest/gtest.h"

#include "tools/view/literal_host.hpp"
#include "tools/view/page_files.hpp"
#include "tools/view/status.hpp"

namespace iog::tools::view {
namespace {

// Names come from captures and from the stream: they may hold anything, and the page gets valid
// JSON (RFC 8259).
TEST(StatusJson, IsJsonWhateverItsWordsHold) {
  const StreamHealth health;
  const FrameAssembler assembler([](GridFrame&& /*frame*/) {});
  const Recorder recorder(".", 0);
  const std::optional<FrameFacts> frame;
  const std::string words = status_json({.health = &health,
                                         .assembler = &assembler,
                                         .recorder = &recorder,
                                         .frame = &frame,
                                         .source = "a\"b\\\n\x01\xff",
                                         .kind = "",
                                         .block = "",
                                         .problem = ""});
  const auto read = nlohmann::json::parse(words);
  EXPECT_EQ(read.at("source"), "a\"b\\\n\x01\uFFFD");
  EXPECT_EQ(read.at("frame"), nullptr);
  EXPECT_EQ(read.at("counts").at("messages"), 0);
}

// What a name service cannot have made up: addresses, and the one name that is always this host.
TEST(LiteralHost, OnlyAddressesAndLocalhostAreHosts) {
  for (const char* host : {"localhost", "localhost:8080", "127.0.0.1", "127.0.0.1:8080",
                           "192.168.1.5:80", "[::1]", "[::1]:8080"}) {
    EXPECT_TRUE(is_literal_host(host)) << host;
  }
  for (const char* host : {"", ":", ":8080", "example.org", "example.org:8080", "localhost.org",
                           "127.0.0.1.example.org", "127.0.0.1@example.org", "[example.org]"}) {
    EXPECT_FALSE(is_literal_host(host)) << host;
  }
}

TEST(PageFiles, ThePageAndWhatItNamesAreThere) {
  const PageFile* const page = page_file("/");
  ASSERT_NE(page, nullptr);
  EXPECT_TRUE(page->content.starts_with("<!doctype html>"));
  EXPECT_TRUE(page->content.ends_with("</html>\n"));
  for (const char* name : {"/view.css", "/view.js", "/icon.svg"}) {
    EXPECT_NE(page_file(name), nullptr) << name;
    EXPECT_NE(page->content.find(name), std::string_view::npos) << name;
  }
  EXPECT_EQ(page_file("/../view.js"), nullptr);
}

// Nothing of the page comes from elsewhere, and it never makes markup of words.
TEST(PageFiles, NothingComesFromElsewhereAndNoWordsBecomeMarkup) {
  for (const PageFile& file : page_files()) {
    EXPECT_EQ(file.content.find("https://"), std::string_view::npos) << file.path;
    for (const char* way :
         {"innerHTML", "outerHTML", "insertAdjacentHTML", "document.write", "eval(", "srcdoc"}) {
      EXPECT_EQ(file.content.find(way), std::string_view::npos) << file.path << ": " << way;
    }
  }
}

}  // namespace
}  // namespace iog::tools::view
