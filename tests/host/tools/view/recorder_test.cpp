#include "tools/view/recorder.hpp"

#include <csignal>
#include <sys/resource.h>
#include <vector>

#include "gtest/gtest.h"

#include "fakes/temporary_folder.hpp"
#include "tools/formats/capture/pcap_reader.hpp"
#include "tools/program/exit_status.hpp"

namespace iog::tools::view {
namespace {

constexpr std::uint64_t kTimeUs = 1'700'000'000'123'456;

class RecorderTest : public testing::Test {
 protected:
  tests::TemporaryFolder parent_;
  std::string folder_ = parent_ / "records";  // the recorder makes it
};

TEST_F(RecorderTest, KeepsEveryMessageAsItWas) {
  Recorder recorder(folder_, 15000);
  recorder.take(std::vector<std::byte>(10), kTimeUs);  // not recorded: nobody has asked
  recorder.start();
  std::vector<std::vector<std::byte>> messages;
  for (std::size_t size : {1U, 100U, 1392U}) {
    messages.emplace_back(size, static_cast<std::byte>(size));
    recorder.take(messages.back(), kTimeUs);
  }
  recorder.take(std::vector<std::byte>(2000), kTimeUs);  // longer than any message of ours
  EXPECT_EQ(recorder.messages(), 3U);
  EXPECT_EQ(recorder.bytes(), 1493U);
  recorder.stop();
  PcapReader capture(recorder.path());
  for (const auto& message : messages) {
    const auto datagram = capture.next();
    ASSERT_TRUE(datagram);
    EXPECT_EQ(datagram->payload, message);
    EXPECT_EQ(datagram->time_us, kTimeUs);
    EXPECT_EQ(datagram->destination.port, 15000);
  }
  EXPECT_FALSE(capture.next());
}

TEST_F(RecorderTest, ARecordingNeverReplacesAnother) {
  Recorder recorder(folder_, 15000);
  recorder.start();
  const std::string first = recorder.path();
  recorder.start();  // already
  EXPECT_EQ(recorder.path(), first);
  recorder.stop();
  recorder.start();
  EXPECT_NE(recorder.path(), first);
  recorder.stop();
}

TEST_F(RecorderTest, WhereNothingCanBeWrittenItSaysSo) {
  Recorder recorder("/dev/null/nowhere", 15000);
  EXPECT_THROW(recorder.start(), UsageError);
  EXPECT_FALSE(recorder.is_open());
}

// No file of this process may be longer; a write beyond fails, as on a full disk.
class SmallDisk {
 public:
  explicit SmallDisk(rlim_t bytes) {
    getrlimit(RLIMIT_FSIZE, &before_);
    const rlimit small{.rlim_cur = bytes, .rlim_max = before_.rlim_max};
    setrlimit(RLIMIT_FSIZE, &small);
    handler_ = std::signal(SIGXFSZ, SIG_IGN);
  }
  ~SmallDisk() {
    setrlimit(RLIMIT_FSIZE, &before_);
    std::signal(SIGXFSZ, handler_);
  }
  SmallDisk(const SmallDisk&) = delete;
  SmallDisk& operator=(const SmallDisk&) = delete;

 private:
  rlimit before_{};
  void (*handler_)(int) = nullptr;
};

TEST_F(RecorderTest, AFullDiskIsToldAtOnceAndEndsTheRecording) {
  Recorder recorder(folder_, 15000);
  recorder.start();
  const SmallDisk disk(50'000);
  const auto record_an_hour = [&] {
    for (int i = 0; i < 1000; ++i) {
      recorder.take(std::vector<std::byte>(1000), kTimeUs);
    }
  };
  EXPECT_THROW(record_an_hour(), UsageError);
  EXPECT_FALSE(recorder.is_open());
  EXPECT_LT(recorder.messages(), 100U);
  EXPECT_NO_THROW(record_an_hour());
}

TEST_F(RecorderTest, ARecordingThatCannotBeEndedWellIsOverAllTheSame) {
  Recorder recorder(folder_, 15000);
  recorder.start();
  recorder.take(std::vector<std::byte>(1000), kTimeUs);
  {
    const SmallDisk disk(500);
    EXPECT_THROW(recorder.stop(), UsageError);
  }
  EXPECT_FALSE(recorder.is_open());
  EXPECT_NO_THROW(recorder.stop());
}

}  // namespace
}  // namespace iog::tools::view
