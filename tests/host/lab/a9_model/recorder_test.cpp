// Regions: what lies between two markers, and what a function does until it returns.
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
constexpr std::uint32_t kReturn = 0xe12fff1e;
constexpr std::uint32_t kDebugHint = 0xe320f0f0;

class Session {
 public:
  explicit Session(const std::vector<Function>& functions = {})
      : recorder_(constants_of(Variant::kNominal), functions) {}

  void at(std::uint32_t address, std::uint32_t word, int times = 1) {
    for (int time = 0; time < times; ++time) {
      const Instruction instruction = decode(word);
      program_.push_back({.address = address,
                          .instruction = instruction,
                          .timing = timing_of(instruction, constants_of(Variant::kNominal))});
      recorder_.begin(program_.back());
      address += 4;
    }
  }
  void mark(std::uint32_t address, std::uint32_t code) {
    at(address, kDebugHint | code >> 4);
    at(address + 4, kDebugHint | (code & 0xf));
  }
  // The number of instructions that the line of a region reports; -1: there is no such line. Key
  // self: without what other functions were reported for.
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

// main calls f at 0x2000 twice; f calls g at 0x3000, which is the function f as well once more.
TEST(Recorder, AFunctionEndsWhereItsCallerGoesOn) {
  Session run({{"f", 0x1000'2000}, {"g", 0x1000'3000}, {"never", 0x1000'4000}});
  for (std::uint32_t time = 0; time < 2; ++time) {
    run.at(0x1000'0000 + time * 4, kCall);
    run.at(0x1000'2000, kAdd, 2);
    run.at(0x1000'2008, kCall);
    run.at(0x1000'3000, kAdd, 4);
    run.at(0x1000'3010, kReturn);
    run.at(0x1000'200c, kAdd, 1);
    run.at(0x1000'2010, kReturn);
  }
  run.at(0x1000'0008, kAdd, 10);
  EXPECT_EQ(run.instructions_of("f"), 2 * 10);
  EXPECT_EQ(run.instructions_of("g"), 2 * 5);
  EXPECT_EQ(run.instructions_of("never"), 0);
}

// main calls f, f calls g, g calls f: what an instruction belongs to is the innermost of them, but
// a function that is under way is not entered again.
TEST(Recorder, WhatAFunctionDoesItselfIsWithoutTheOthers) {
  Session run({{"f", 0x1000'2000}, {"g", 0x1000'3000}});
  run.at(0x1000'0000, kCall);
  run.at(0x1000'2000, kAdd, 2);
  run.at(0x1000'2008, kCall);
  run.at(0x1000'3000, kAdd, 4);
  run.at(0x1000'3010, kCall);
  run.at(0x1000'2000, kAdd, 6);
  run.at(0x1000'2018, kReturn);
  run.at(0x1000'3014, kReturn);
  run.at(0x1000'200c, kAdd, 1);
  run.at(0x1000'2010, kReturn);
  run.at(0x1000'0004, kAdd, 9);
  EXPECT_EQ(run.instructions_of("g", "self"), 4 + 1 + 6 + 1 + 1);
  EXPECT_EQ(run.instructions_of("f", "self"), 2 + 1 + 1 + 1);
  EXPECT_EQ(run.instructions_of("f", "self") + run.instructions_of("g", "self"),
            run.instructions_of("f"));
}

// A call and its function are under way while the program warms up.
TEST(Recorder, WhatCameBeforeIsForgotten) {
  Session run({{"f", 0x1000'2000}});
  run.mark(0x1000'0000, 5);
  run.at(0x1000'0008, kCall);
  run.at(0x1000'2000, kAdd, 2);
  run.mark(0x1000'2008, kMarkerForget);
  run.at(0x1000'2010, kAdd, 4);
  run.at(0x1000'2020, kReturn);
  run.at(0x1000'000c, kAdd, 3);
  run.mark(0x1000'0018, 5 | kMarkerEnd);
  EXPECT_EQ(run.instructions_of("f"), 5);
  EXPECT_EQ(run.instructions_of("f", "self"), 5);
  EXPECT_EQ(run.instructions_of("5"), 8);
  EXPECT_EQ(run.instructions_of("all"), 8);
}

// The program comes back from another call than the one that it paused in.
TEST(Recorder, BetweenPauseAndResumeNothingIsModelled) {
  Session run({{"f", 0x1000'2000}});
  run.at(0x1000'0000, kAdd, 3);
  run.mark(0x1000'000c, kMarkerPause);
  run.at(0x1000'0014, kCall);
  run.at(0x1000'2000, kAdd, 4);
  run.mark(0x1000'2010, kMarkerResume);
  run.at(0x1000'2018, kAdd, 2);
  run.at(0x1000'2020, kReturn);
  run.at(0x1000'0018, kCall);
  run.at(0x1000'2000, kAdd, 5);
  run.at(0x1000'2014, kReturn);
  run.at(0x1000'001c, kAdd, 1);
  EXPECT_EQ(run.instructions_of("all"), 3 + 3 + 1 + 6 + 1);
  EXPECT_EQ(run.instructions_of("f"), 6);
  EXPECT_EQ(run.instructions_of("f", "self"), 6);
}

// A round may end while a function is under way. What came before the first is in no round.
TEST(Recorder, RoundsAreReportedOneByOne) {
  Session run({{"f", 0x1000'2000}});
  run.at(0x1000'0000, kCall);
  run.at(0x1000'2000, kAdd, 7);
  run.mark(0x1000'201c, kMarkerForget);
  run.at(0x1000'2024, kAdd, 2);
  run.at(0x1000'202c, kReturn);
  run.at(0x1000'0004, kAdd, 9);
  run.mark(0x1000'0028, kMarkerRound);
  run.at(0x1000'0030, kCall);
  run.at(0x1000'2000, kAdd, 4);
  run.mark(0x1000'2010, kMarkerRound);
  EXPECT_EQ(run.instructions_of("f", "round=0 of"), 3);
  EXPECT_EQ(run.instructions_of("f", "round=1 of"), 4);
  EXPECT_EQ(run.instructions_of("f", "round=2 of"), -1);
}

TEST(Recorder, AJumpToAFunctionReturnsToTheCallersCaller) {
  Session run({{"g", 0x1000'3000}});
  run.at(0x1000'0000, kCall);
  run.at(0x1000'2000, 0xea0003fe);  // b g
  run.at(0x1000'3000, kAdd, 4);
  run.at(0x1000'3010, kReturn);
  run.at(0x1000'0004, kAdd, 9);
  EXPECT_EQ(run.instructions_of("g"), 5);
}

}  // namespace
}  // namespace iog::a9_model
