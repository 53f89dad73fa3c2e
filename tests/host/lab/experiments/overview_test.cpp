#include "lab/experiments/overview.hpp"

#include <array>
#include <chrono>
#include <cstddef>
#include <set>
#include <stdexcept>
#include <string>
#include <thread>
#include <vector>

#include "gtest/gtest.h"

#include "lab/experiments/page.hpp"
#include "tools/program/exit_status.hpp"

namespace iog::lab {
namespace {

Section slow_section(const TablesInput& /*input*/) {
  std::this_thread::sleep_for(std::chrono::milliseconds(20));
  Section section;
  section.body.heading("Slow");
  section.claims.push_back({"table 1", "slowness", "1", "1", Verdict::kEquals, ""});
  return section;
}

Section quick_section(const TablesInput& input) {
  Section section;
  section.body.heading("Quick");
  section.body.paragraph("seed " + std::to_string(input.seed));
  section.claims.push_back({"table 2", "quickness", "1", "2", Verdict::kBeats, "it hurries"});
  return section;
}

Section failing_section(const TablesInput& /*input*/) { throw std::out_of_range("no such run"); }
Section refusing_section(const TablesInput& /*input*/) {
  throw tools::UsageError("capture: unreadable");
}

constexpr auto kSilent = [](std::size_t) {};

TEST(Page, SectionsComeInTheirOrderWhateverTimeTheyTake) {
  constexpr std::array<NamedSection, 5> kSections{{{"a", slow_section},
                                                   {"b", quick_section},
                                                   {"c", slow_section},
                                                   {"d", quick_section},
                                                   {"e", quick_section}}};
  std::set<std::size_t> done;
  const TablesInput input{.seed = 7, .recordings = {}, .figures = {}};
  const std::vector<Section> sections =
      compute(kSections, input, [&done](std::size_t count) { done.insert(count); });
  EXPECT_EQ(done, (std::set<std::size_t>{1, 2, 3, 4, 5}));
  ASSERT_EQ(sections.size(), kSections.size());
  for (std::size_t i = 0; i < sections.size(); ++i) {
    EXPECT_EQ(sections[i].body.text(), kSections[i].compute(input).body.text());
  }
}

TEST(Page, AFailureNamesItsSection) {
  constexpr std::array<NamedSection, 2> kSections{
      {{"good", quick_section}, {"bad", failing_section}}};
  try {
    static_cast<void>(compute(kSections, {}, kSilent));
    ADD_FAILURE() << "a failure was lost";
  } catch (const std::runtime_error& error) {
    EXPECT_STREQ(error.what(), "section bad failed: no such run");
  }
}

TEST(Page, WrongUseStaysWrongUse) {
  constexpr std::array<NamedSection, 1> kSections{{{"strict", refusing_section}}};
  EXPECT_THROW(static_cast<void>(compute(kSections, {}, kSilent)), tools::UsageError);
}

TEST(Page, HoldsEveryClaimAndEverySectionOnce) {
  constexpr std::array<NamedSection, 2> kSections{{{"a", slow_section}, {"b", quick_section}}};
  const TablesInput input{.seed = 7, .recordings = {}, .figures = {}};
  const std::string page = page_of(input, compute(kSections, input, kSilent));
  std::size_t at = 0;
  for (const char* part : {"# Results\n", "--seed 7", "## Overview", "| slowness ", "| quickness ",
                           "## Slow", "## Quick", "## Made with"}) {
    const std::size_t found = page.find(part, at);
    EXPECT_NE(found, std::string::npos) << part;
    at = found == std::string::npos ? at : found;
  }
}

TEST(Page, ARecordingIsKnownByItsNameNotByItsPlace) {
  const TablesInput input{.recordings = {{"/secret/place/street.pcap", "roof_vlp16"}},
                          .figures = {}};
  const std::string page = page_of(input, {});
  EXPECT_NE(page.find("street.pcap"), std::string::npos);
  EXPECT_EQ(page.find("secret"), std::string::npos);
}

TEST(Page, EachSectionHasItsOwnName) {
  std::set<std::string_view> names;
  for (const NamedSection& section : all_sections()) {
    EXPECT_TRUE(names.insert(section.name).second) << section.name;
  }
}

TEST(Overview, ADifferenceWithoutAReasonIsRefused) {
  for (const Verdict verdict : {Verdict::kBeats, Verdict::kFallsShort, Verdict::kDeparts}) {
    Markdown page;
    EXPECT_THROW(add_overview(page, {{"table 1", "size", "1", "2", verdict, ""}}),
                 std::invalid_argument);
  }
}

TEST(Overview, VerdictsAreCounted) {
  Markdown page;
  add_overview(page, {{"table 1", "a", "1", "1", Verdict::kEquals, ""},
                      {"table 1", "b", "1", "1", Verdict::kEquals, ""},
                      {"table 1", "c", "1", "0", Verdict::kFallsShort, "slow"}});
  EXPECT_NE(page.text().find("3 claims"), std::string::npos);
  EXPECT_NE(page.text().find("2 \"equal\""), std::string::npos);
  EXPECT_NE(page.text().find("1 \"short of it\""), std::string::npos);
}

}  // namespace
}  // namespace iog::lab
