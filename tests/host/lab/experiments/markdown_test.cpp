#include "lab/experiments/markdown.hpp"

#include <cstddef>
#include <sstream>
#include <stdexcept>
#include <string>
#include <vector>

#include "gtest/gtest.h"

namespace iog::lab {
namespace {

std::vector<std::string> lines_of(const std::string& text) {
  std::istringstream stream(text);
  std::vector<std::string> lines;
  for (std::string line; std::getline(stream, line);) {
    lines.push_back(line);
  }
  return lines;
}

// Blanks apart, what is written is what was said.
std::string words_of(const std::string& text) {
  std::istringstream stream(text);
  std::string words;
  for (std::string word; stream >> word;) {
    words += (words.empty() ? "" : " ") + word;
  }
  return words;
}

TEST(Markdown, ParagraphsAreBrokenAtBlanksInto100Columns) {
  std::string said = "§";
  for (std::size_t length = 1; length < 60; ++length) {
    said.append(" ").append(length % 23 + 1, 'x');
  }
  Markdown text;
  text.paragraph(said);
  EXPECT_EQ(words_of(text.text()), said);
  const std::vector<std::string> lines = lines_of(text.text());
  ASSERT_GT(lines.size(), 2U);
  for (std::size_t i = 0; i < lines.size(); ++i) {
    EXPECT_LE(lines[i].size(), i == 0 ? 101U : 100U);  // § has two bytes
    // No line ends while the next word still has room.
    if (i + 1 < lines.size()) {
      const std::string next = lines[i + 1].substr(0, lines[i + 1].find(' '));
      EXPECT_GT(lines[i].size() + 1 + next.size(), 100U);
    }
  }
}

// CommonMark 0.30, sections 4.2, 4.3, 5.1 and 5.2: what would begin a heading, a rule, a quotation
// or a list may not come to stand at the beginning of a line.
TEST(Markdown, NoWordBecomesAMarkByBreakingALine) {
  for (const std::string mark : {"-", "+", "*", "#", "##", ">", ">5", "=", "---", "1.", "12)"}) {
    for (std::size_t before = 90; before <= 105; ++before) {
      Markdown text;
      text.paragraph(std::string(before - 4, 'x') + " yyy " + mark + " behind");
      for (const std::string& line : lines_of(text.text())) {
        EXPECT_NE(line.substr(0, line.find(' ')), mark);
      }
    }
  }
}

TEST(Markdown, ItemsOfOneListStandTogetherBlocksApart) {
  Markdown text;
  text.heading("Head");
  text.paragraph("before");
  text.item("one");
  text.item("two " + std::string(97, 'x') + " three");
  text.paragraph("behind");
  EXPECT_EQ(text.text(), "## Head\n\nbefore\n\n- one\n- two\n  " + std::string(97, 'x') +
                             "\n  three\n\nbehind\n");
}

TEST(Markdown, ColumnsOfNumbersAreAlignedRightOthersLeft) {
  Markdown text;
  text.table({"what", "number", "with unit", "mixed"},
             {{"a", "-1.5", "66 Hz", "12"}, {"bcd", "1,048,576", "–", "12 to 13"}});
  EXPECT_EQ(text.text(),
            "| what |    number | with unit | mixed    |\n"
            "|------|----------:|----------:|----------|\n"
            "| a    |      -1.5 |     66 Hz | 12       |\n"
            "| bcd  | 1,048,576 |         – | 12 to 13 |\n");
}

// GitHub Flavored Markdown, section 4.10: a bar in a cell is written as \|; a row is one line.
TEST(Markdown, NoCellCanBreakItsTable) {
  Markdown text;
  text.table({"|a|", "b"}, {{"x\ny", "||"}, {"ε̄ = 0.05", "z"}});
  EXPECT_EQ(text.text(),
            "| \\|a\\|    | b    |\n"
            "|----------|------|\n"
            "| x y      | \\|\\| |\n"
            "| ε̄ = 0.05 | z    |\n");
}

// A terminal of 100 columns breaks such a row where its words end, not where blanks would.
TEST(Markdown, ATableWiderThanALineEndsWithItsWords) {
  Markdown text;
  text.table({"a", "reason"}, {{"b", ""}, {"c", std::string(100, 'x')}});
  EXPECT_EQ(text.text(),
            "| a   | reason |\n"
            "|-----|--------|\n"
            "| b   |        |\n"
            "| c   | " +
                std::string(100, 'x') + " |\n");
}

TEST(Markdown, ARowOfAnotherLengthIsRefused) {
  Markdown text;
  EXPECT_THROW(text.table({"a", "b"}, {{"only one"}}), std::invalid_argument);
}

TEST(Markdown, AppendingIsWritingOn) {
  Markdown first;
  first.paragraph("one");
  Markdown second;
  second.paragraph("two");
  first.append(second);
  EXPECT_EQ(first.text(), "one\n\ntwo\n");
}

TEST(Numbers, AreRoundedToTheNearestAndNeverMinusZero) {
  EXPECT_EQ(fixed(0.6036, 3), "0.604");
  EXPECT_EQ(fixed(-0.004, 2), "0.00");
  EXPECT_EQ(fixed(-0.006, 2), "-0.01");
  EXPECT_EQ(percent(0.995, 2), "99.50 %");
  EXPECT_EQ(scientific(0.000465, 2), "4.65e-4");
  EXPECT_EQ(scientific(120000, 1), "1.2e5");
  EXPECT_EQ(scientific(1, 0), "1e0");
  EXPECT_EQ(scientific(1e-10, 0), "1e-10");
  EXPECT_EQ(scientific(0, 1), "0.0e0");
}

TEST(Numbers, GroupsHaveThreeDigits) {
  EXPECT_EQ(grouped(0), "0");
  EXPECT_EQ(grouped(999), "999");
  EXPECT_EQ(grouped(1000), "1,000");
  EXPECT_EQ(grouped(1048575.6), "1,048,576");
  EXPECT_EQ(grouped(-700000), "-700,000");
  EXPECT_EQ(grouped(-999), "-999");
}

}  // namespace
}  // namespace iog::lab
