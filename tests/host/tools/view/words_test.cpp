#include "gtest/gtest.h"

#include "tools/view/json_text.hpp"
#include "tools/view/literal_host.hpp"
#include "tools/view/page_files.hpp"

namespace iog::tools::view {
namespace {

// RFC 8259, section 7.
TEST(JsonText, WhatIsNotPrintableIsEscaped) {
  EXPECT_EQ(quoted("city, seed 1"), R"("city, seed 1")");
  EXPECT_EQ(quoted("a\"b\\c"), R"("a\"b\\c")");
  EXPECT_EQ(quoted("\n\x01\x7f\u00a9"), "\"\\u000a\\u0001\\u007f\u00a9\"");
  EXPECT_EQ(quoted(std::string_view("\0", 1)), "\"\\u0000\"");
}

TEST(JsonText, ObjectsAndListsNest) {
  const std::string list = JsonList().json("1").text("two").str();
  EXPECT_EQ(JsonObject().number("a", -5).truth("b", true).json("c", list).real("d", 0.5).str(),
            R"({"a":-5,"b":true,"c":[1,"two"],"d":0.5})");
  EXPECT_EQ(JsonObject().str(), "{}");
  EXPECT_EQ(JsonList().str(), "[]");
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
