// Session ids, the reboot flag and what a reboot is: the three cases of the standard's section
// "Reboot Detection".
#include "discovery/sessions.hpp"

#include <gtest/gtest.h>

namespace iog::discovery {
namespace {

TEST(Sessions, CountFromOneWithTheFlagUntilTheyWrap) {
  SessionCounter counter;
  for (unsigned id = 1; id <= 0xFFFF; ++id) {
    const Session session = counter.take();
    ASSERT_EQ(session.id, id);
    ASSERT_TRUE(session.reboot);
  }
  for (unsigned id = 1; id <= 3; ++id) {
    const Session session = counter.take();
    EXPECT_EQ(session.id, id);
    EXPECT_FALSE(session.reboot);
  }
}

bool is_rebooted(Session before, Session now) {
  SessionWatch watch;
  EXPECT_FALSE(watch.is_rebooted(before)) << "the first that is heard";
  return watch.is_rebooted(now);
}

TEST(Sessions, ARebootIsAFlagThatComesBackOrAnIdThatDoesNotRise) {
  EXPECT_TRUE(is_rebooted({.id = 7, .reboot = false}, {.id = 1, .reboot = true}));
  EXPECT_TRUE(is_rebooted({.id = 7, .reboot = true}, {.id = 1, .reboot = true}));
  EXPECT_TRUE(is_rebooted({.id = 7, .reboot = true}, {.id = 7, .reboot = true}));
  EXPECT_FALSE(is_rebooted({.id = 7, .reboot = true}, {.id = 8, .reboot = true}));
  EXPECT_FALSE(is_rebooted({.id = 7, .reboot = true}, {.id = 900, .reboot = true})) << "some lost";
  EXPECT_FALSE(is_rebooted({.id = 0xFFFF, .reboot = true}, {.id = 1, .reboot = false}));
  EXPECT_FALSE(is_rebooted({.id = 0xFFFF, .reboot = false}, {.id = 1, .reboot = false}));
}

// A counter of one target never looks like a reboot to whoever hears a part of it.
TEST(Sessions, NobodyTakesAWrapForAReboot) {
  SessionCounter counter;
  SessionWatch each;
  SessionWatch some;
  for (unsigned i = 0; i < 3 * 0xFFFF; ++i) {
    const Session session = counter.take();
    ASSERT_FALSE(each.is_rebooted(session));
    ASSERT_FALSE(i % 7 == 0 && some.is_rebooted(session));
  }
}

}  // namespace
}  // namespace iog::discovery
