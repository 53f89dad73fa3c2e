#include <csignal>
#include <cstdlib>
#include <filesystem>
#include <string>
#include <string_view>

#include "gtest/gtest.h"

#include "../drive_sample.hpp"
#include "fakes/temporary_folder.hpp"
#include "tools/formats/capture/made_capture.hpp"
#include "tools/program/interrupt.hpp"
#include "tools/record/mcap_recording.hpp"
#include "tools/view/sources.hpp"

namespace iog::tools::view {
namespace {

constexpr std::string_view kCar = "reference_car";

void write_stream(const std::string& path) {
  const CatalogueEntry& car = find_vehicle(std::string(kCar));
  McapRecording recording(path, {std::string(kMessagesTopic)}, mcap::Compression::kZstd);
  std::uint64_t time_us = 1'000'000;
  for (const auto& message : messages_of(car, sample_drive(car, 1, 3))) {
    recording.take_datagram(datagram_of_stream(time_us += 100, message));
  }
  recording.finish({});
}

// What the source says on stderr while it is made, and how it ends, is that of a process.
[[noreturn]] void read_through(const std::string& path) {
  (void)make_recording_source(
      {.drive = {{path}}, .vehicle = std::string(kCar), .port = 15000, .speed = 1, .loops = false});
  std::exit(0);
}

[[noreturn]] void read_through_interrupted(const std::string& path) {
  catch_interrupts();
  std::raise(SIGINT);
  read_through(path);
}

class RecordingSourceTest : public testing::Test {
 protected:
  RecordingSourceTest() { write_stream(path_); }

  tests::TemporaryFolder folder_;
  std::string path_ = folder_ / "stream.mcap";
};

TEST_F(RecordingSourceTest, OfAWholeFileNothingIsSaid) {
  EXPECT_EXIT(read_through(path_), testing::ExitedWithCode(0), "^$");
}

TEST_F(RecordingSourceTest, AFileThatBreaksOffIsSaidTo) {
  std::filesystem::resize_file(path_, std::filesystem::file_size(path_) - 200);
  EXPECT_EXIT(read_through(path_), testing::ExitedWithCode(0), "breaks off or is damaged");
}

TEST_F(RecordingSourceTest, AWholeFileThatASignalStopsBeingReadIsNotCalledDamaged) {
  EXPECT_EXIT(read_through_interrupted(path_), testing::ExitedWithCode(0), "^$");
}

}  // namespace
}  // namespace iog::tools::view
