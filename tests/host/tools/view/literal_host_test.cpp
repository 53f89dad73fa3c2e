// Who may read along over the WebSocket of Foxglove: no page of the internet that a browser of this
// PC happens to have open.
#include "tools/view/literal_host.hpp"

#include "gtest/gtest.h"

namespace iog::tools::view {
namespace {

constexpr const char* kHere = "192.168.1.7:8765";

TEST(FoxgloveOrigin, ProgramsAndFoxgloveAndPagesOfThisPcMay) {
  for (const char* origin : {"", "https://app.foxglove.dev", "https://studio.foxglove.dev",
                             "file://", "app://lichtblick", "http://localhost:8080",
                             "http://127.0.0.1", "http://[::1]:3000", "http://192.168.1.7:8080"}) {
    EXPECT_TRUE(is_foxglove_or_here(origin, kHere)) << origin;
  }
}

TEST(FoxgloveOrigin, OthersMayNot) {
  for (const char* origin :
       {"null", "https://example.com", "http://app.foxglove.dev",
        "https://foxglove.dev.example.com", "https://notfoxglove.dev", "http://192.168.1.8",
        "http://localhost.example.com", "https://127.0.0.1.example.com", "example.com"}) {
    EXPECT_FALSE(is_foxglove_or_here(origin, kHere)) << origin;
  }
}

}  // namespace
}  // namespace iog::tools::view
