// Who sends commands signs them for one run of a target, and reads the key from a file.
#include "tools/replay/command_signer.hpp"

#include <gtest/gtest.h>
#include <string>

#include "fakes/pose_bytes.hpp"
#include "fakes/temporary_folder.hpp"
#include "pose/message.hpp"
#include "tools/program/exit_status.hpp"
#include "tools/program/file.hpp"
#include "tools/vehicles/key_file.hpp"

namespace iog::tools {
namespace {

using authentication::Verdict;
using Sent = std::vector<std::byte>;

constexpr authentication::Key kKey{std::byte{7}};
constexpr std::uint32_t kRun = 0xC0FFEE;

class Signer : public ::testing::Test {
 protected:
  Sent sent(std::span<const std::byte> message) {
    return signer_.as_sent(pose::kPoseChannel, message);
  }

  Sent pose_ = tests::PoseBytes().bytes();
  CommandSigner signer_{kKey, {.run = kRun, .counter = 41}};
  authentication::CmacKey key_{kKey};
  authentication::Verifier verifier_{key_, 0x8003, kRun};
};

TEST_F(Signer, EachMessageIsNewerThanTheOneBefore) {
  for (std::uint32_t counter = 42; counter < 45; ++counter) {
    EXPECT_EQ(verifier_.verify(sent(pose_)), Verdict::kAuthentic);
    EXPECT_EQ(verifier_.counter(), counter);
  }
}

// As a recording on the way to a target has them.
TEST_F(Signer, ASignedMessageIsSignedAnew) {
  const Sent once = sent(pose_);
  const Sent twice = sent(once);
  EXPECT_EQ(twice.size(), once.size());
  EXPECT_EQ(verifier_.verify(twice), Verdict::kAuthentic);
  Sent stripped(pose_.size());
  authentication::strip(twice, stripped);
  EXPECT_EQ(stripped, pose_);
}

TEST_F(Signer, WhatIsNoMessageStaysAsItIs) {
  EXPECT_EQ(sent(Sent(27)), Sent(27));
  EXPECT_EQ(sent(Sent(2'000)), Sent(2'000));
  EXPECT_EQ(CommandSigner().as_sent(pose::kPoseChannel, pose_), pose_) << "without a key";
}

TEST_F(Signer, NoCounterIsUsedTwice) {
  CommandSigner last(kKey, {.run = kRun, .counter = 0xFFFFFFFE});
  EXPECT_EQ(verifier_.verify(last.as_sent(pose::kPoseChannel, pose_)), Verdict::kAuthentic);
  EXPECT_THROW(static_cast<void>(last.as_sent(pose::kPoseChannel, pose_)), UsageError);
}

TEST(KeyFile, HoldsThirtyTwoDigits) {
  const tests::TemporaryFolder folder;
  const std::string path = folder / "car.key";
  const auto key_in = [&](std::string_view text) {
    OutputFile file(path);
    file.write(text);
    file.finish();
    return read_key_file(path);
  };
  EXPECT_EQ(key_in("  000102030405060708090a0b0c0d0E0F\r\n")[15], std::byte{15});
  EXPECT_EQ(warning_of_key_file("car", path) + warning_of_key_file("car", ""), "");
  for (const std::string_view text :
       {"", "00", "00000000000000000000000000000000", "000102030405060708090a0b0c0d0e0f10",
        "000102030405060708090a0b0c0d0e0g", "0x0102030405060708090a0b0c0d0e0f",
        "000102030405060708090a0b0c0d0e0f 00", "00010203 0405060708090a0b0c0d0e0f",
        "-1010203040506070809010203040506"}) {
    EXPECT_THROW(static_cast<void>(key_in(text)), UsageError) << text;
  }
  EXPECT_TRUE(warning_of_key_file("car", path)
                  .starts_with("warning: car: key_file " + path + ": a key is"));
  EXPECT_THROW(static_cast<void>(read_key_file(folder / "none.key")), UsageError);
}

}  // namespace
}  // namespace iog::tools
