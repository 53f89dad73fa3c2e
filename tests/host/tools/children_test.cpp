#include "tools/batch/children.hpp"

#include <chrono>
#include <csignal>
#include <cstdlib>
#include <thread>

#include "gtest/gtest.h"

#include "fakes/temporary_folder.hpp"
#include "tools/program/interrupt.hpp"

namespace iog::tools {
namespace {

// The child: this program with this test alone.
TEST(Children, DISABLED_Sleep) { std::this_thread::sleep_for(std::chrono::seconds(20)); }

// Ctrl-C between a caller's look for it and the wait.
TEST(Children, AnInterruptBeforeTheWaitEndsIt) {
  const tests::TemporaryFolder folder;
  const auto is_ended = [&] {
    catch_interrupts();
    Children children(folder / "", 1);
    children.start(0, 7, {"tests", "--gtest_also_run_disabled_tests", "--gtest_filter=*_Sleep"});
    std::raise(SIGINT);
    return !children.wait() && children.are_running();
  };
  EXPECT_EXIT(std::_Exit(is_ended() ? 0 : 1), testing::ExitedWithCode(0), "");
}

}  // namespace
}  // namespace iog::tools
