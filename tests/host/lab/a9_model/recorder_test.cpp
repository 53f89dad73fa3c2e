// Regions: what lies between two markers. Stages: what lies in a function, and what it calls.
#include "lab/a9_model/recorder.hpp"

#include <deque>
#include <gtest/gtest.h>
#include <sstream>

#include "lab/a9_model/decode.hpp"
#include "lab/a9_model/marker.hpp"

namespace iog::a9_model {
namespace {

constexpr std::uint32_t kAdd = 0xe0811002;  // add r1, r1, r2
constexpr std::uint32_t kCall = 0xebfffffe;
constexpr std::uint32_t kJump = 0xeafffffe;
constexpr std::uint32_t kReturn = 0xe12fff1e;
constexpr std::uint32_t kDebugHint = 0xe320f0f0;

// Stages of these tests: f is 1, g is 2. Functions have 0x1000 bytes.
constexpr std::uint8_t kNone = 0;
constexpr std::uint8_t kF = 1;
constexpr std::uint8_t kG = 2;

class Session {
 public:
  Session() : recorder_(constants_of(Variant::kNominal), kStages) {}

  void at(std::uint32_t address, std::uint32_t word, int times = 1, std::uint8_t stage = kNone) {
    for (int time = 0; time < times; ++time) {
      const Instruction instruction = decode(word);
      program_.push_back({.address = address,
                          .instruction = instruction,
                          .timing = timing_of(instruction, constants_of(Variant::kNominal)),
                          .place = {.stage = stage, .function = address / 0x1000}});
      recorder_.begin(program_.back());
      address += 4;
    }
  }
  void mark(std::uint32_t address, std::uint32_t code) {
    at(address, kDebugHint | code >> 4);
    at(address + 4, kDebugHint | (code & 0xf));
  }
  // The number of instructions that the line of a region reports, or with key self that of a stage;
  // -1: there is no such line.
  int instructions_of(const std::string& region, const std::string& key = "region") {
    std::ostringstream out;
    recorder_.report(out, "modelled");
    std::istringstream lines(out.str());
    for (std::string line; std::getline(lines, line);) {
      if (line.find(std::string(" ").append(key).append("=").append(region).append(" ")) !=
          std::string::npos) {
        const std::size_t at = line.find(" instructions=");
        return std::stoi(line.substr(at + 14));
      }
    }
    return -1;
  }

 private:
  inline static const std::vector<std::string> kStages{"", "f", "g"};

  Recorder recorder_;
  std::deque<ProgramInstruction> program_;
};

TEST(Recorder, CountsWhatLiesBetweenMarkersAndNotTheMarkers) {
  Session run;
  run.at(0x1000'0000, kAdd, 5);
  run.mark(0x1000'0014, 17);
  run.at(0x1000'001c, kAdd, 7);
  run.mark(0x1000'0038, 17 | kMarkerEnd);
  run.at(0x1000'0040, kAdd, 3);
  EXPECT_EQ(run.instructions_of("17"), 7);
  EXPECT_EQ(run.instructions_of("all"), 15);
  EXPECT_EQ(run.instructions_of("18"), -1);
}

TEST(Recorder, RegionsMayOverlapAndRepeat) {
  Session run;
  for (int time = 0; time < 2; ++time) {
    run.mark(0x1000'0000, 1);
    run.at(0x1000'0008, kAdd, 2);
    run.mark(0x1000'0010, 2);
    run.at(0x1000'0018, kAdd, 3);
    run.mark(0x1000'0024, 1 | kMarkerEnd);
    run.at(0x1000'002c, kAdd, 4);
    run.mark(0x1000'003c, 2 | kMarkerEnd);
  }
  EXPECT_EQ(run.instructions_of("1"), 10);
  EXPECT_EQ(run.instructions_of("2"), 14);
}

// main calls f, f calls a helper that lies in no stage, and g.
TEST(Recorder, WhatAStageCallsIsItsOwnUnlessItIsAnothers) {
  Session run;
  for (std::uint32_t time = 0; time < 2; ++time) {
    run.at(0x1000'0000 + time * 4, kCall);
    run.at(0x1000'2000, kAdd, 2, kF);
    run.at(0x1000'2008, kCall, 1, kF);
    run.at(0x1000'5000, kAdd, 3);
    run.at(0x1000'500c, kReturn);
    run.at(0x1000'200c, kCall, 1, kF);
    run.at(0x1000'3000, kAdd, 4, kG);
    run.at(0x1000'3010, kReturn, 1, kG);
    run.at(0x1000'2010, kAdd, 1, kF);
    run.at(0x1000'2014, kReturn, 1, kF);
  }
  run.at(0x1000'0008, kAdd, 10);
  EXPECT_EQ(run.instructions_of("f", "self"), 2 * (3 + 4 + 3));
  EXPECT_EQ(run.instructions_of("g", "self"), 2 * 5);
  EXPECT_EQ(run.instructions_of("all"), 2 * (1 + 10 + 5) + 10);
}

// The compiler has put f into main, and g into f.
TEST(Recorder, AFunctionThatLiesInAnotherIsAStageAllTheSame) {
  Session run;
  run.at(0x1000'0000, kAdd, 2);
  run.at(0x1000'0008, kAdd, 3, kF);
  run.at(0x1000'0014, kAdd, 1, kG);
  run.at(0x1000'0018, kCall, 1, kG);
  run.at(0x1000'5000, kAdd, 6);
  run.at(0x1000'5018, kReturn);
  run.at(0x1000'001c, kAdd, 1, kF);
  run.at(0x1000'0020, kAdd, 5);
  EXPECT_EQ(run.instructions_of("f", "self"), 4);
  EXPECT_EQ(run.instructions_of("g", "self"), 1 + 1 + 7);
}

// A call is under way while the program warms up.
TEST(Recorder, WhatCameBeforeIsForgotten) {
  Session run;
  run.mark(0x1000'0000, 5);
  run.at(0x1000'0008, kCall);
  run.at(0x1000'2000, kAdd, 2, kF);
  run.mark(0x1000'2008, kMarkerForget);
  run.at(0x1000'2010, kAdd, 4, kF);
  run.at(0x1000'2020, kReturn, 1, kF);
  run.at(0x1000'000c, kAdd, 3);
  run.mark(0x1000'0018, 5 | kMarkerEnd);
  EXPECT_EQ(run.instructions_of("f", "self"), 5);
  EXPECT_EQ(run.instructions_of("5"), 8);
  EXPECT_EQ(run.instructions_of("all"), 8);
}

// The program comes back from another call than the one that it paused in.
TEST(Recorder, BetweenPauseAndResumeNothingIsModelled) {
  Session run;
  run.at(0x1000'0000, kAdd, 3);
  run.mark(0x1000'000c, kMarkerPause);
  run.at(0x1000'0014, kCall);
  run.at(0x1000'2000, kAdd, 4, kF);
  run.mark(0x1000'2010, kMarkerResume);
  run.at(0x1000'2018, kAdd, 2, kF);
  run.at(0x1000'2020, kReturn, 1, kF);
  run.at(0x1000'0018, kCall);
  run.at(0x1000'2000, kAdd, 5, kF);
  run.at(0x1000'2014, kReturn, 1, kF);
  run.at(0x1000'001c, kAdd, 1);
  EXPECT_EQ(run.instructions_of("all"), 3 + 3 + 1 + 6 + 1);
  EXPECT_EQ(run.instructions_of("f", "self"), 3 + 6);
}

// A round may end while a call is under way. What came before the first is in no round.
TEST(Recorder, RoundsAreReportedOneByOne) {
  Session run;
  run.at(0x1000'0000, kCall);
  run.at(0x1000'2000, kAdd, 7, kF);
  run.mark(0x1000'201c, kMarkerForget);
  run.at(0x1000'2024, kAdd, 2, kF);
  run.at(0x1000'202c, kReturn, 1, kF);
  run.at(0x1000'0004, kAdd, 9);
  run.mark(0x1000'0028, kMarkerRound);
  run.at(0x1000'0030, kCall);
  run.at(0x1000'2000, kAdd, 4, kF);
  run.mark(0x1000'2010, kMarkerRound);
  EXPECT_EQ(run.instructions_of("f", "round=0 of"), 3);
  EXPECT_EQ(run.instructions_of("f", "round=1 of"), 4);
  EXPECT_EQ(run.instructions_of("f", "round=2 of"), -1);
}

// f ends with a jump to a function in no stage, which goes back to f's caller.
TEST(Recorder, AJumpToAnotherFunctionIsACall) {
  Session run;
  run.at(0x1000'0000, kCall);
  run.at(0x1000'2000, kAdd, 1, kF);
  run.at(0x1000'2004, kJump, 1, kF);
  run.at(0x1000'3000, kAdd, 4);
  run.at(0x1000'3010, kReturn);
  run.at(0x1000'0004, kAdd, 9);
  EXPECT_EQ(run.instructions_of("f", "self"), 2 + 5);
}

// Of a branch within a function the stage is that of where it lies.
TEST(Recorder, AJumpWithinAFunctionIsNone) {
  Session run;
  run.at(0x1000'0000, kAdd, 1, kF);
  run.at(0x1000'0004, kJump, 1, kF);
  run.at(0x1000'0100, kAdd, 3);
  EXPECT_EQ(run.instructions_of("f", "self"), 2);
}

}  // namespace
}  // namespace iog::a9_model
