// A text that reads well on a terminal and as Markdown: paragraphs, tables with aligned columns.
#pragma once

#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

namespace iog::lab {

class Markdown {
 public:
  void title(std::string_view words);       // # words
  void heading(std::string_view words);     // ## words
  void subheading(std::string_view words);  // ### words
  void paragraph(std::string_view words);   // broken into lines of at most 100 characters
  void item(std::string_view words);        // of a list

  // Every row has a cell for each column; std::invalid_argument if not. A column whose cells all
  // look like numbers, some with a unit, is aligned to the right.
  void table(const std::vector<std::string>& columns,
             const std::vector<std::vector<std::string>>& rows);

  // A picture beside the text, by a path relative to it.
  void picture(std::string_view path, std::string_view caption);

  // What another text holds, behind this one.
  void append(const Markdown& other);

  [[nodiscard]] const std::string& text() const { return text_; }

 private:
  enum class Block : std::uint8_t { kOther, kItem };

  void begin(Block block);

  std::string text_;
  Block last_ = Block::kOther;
};

// Numbers as the tables show them.
[[nodiscard]] std::string fixed(double value, int decimals);       // 0.604
[[nodiscard]] std::string scientific(double value, int decimals);  // 4.65e-4
[[nodiscard]] std::string percent(double share, int decimals);     // 99.50 % of a share of 0.995
[[nodiscard]] std::string grouped(double value);                   // 1,048,576, rounded

}  // namespace iog::lab
