#include "lab/experiments/markdown.hpp"

#include <algorithm>
#include <array>
#include <charconv>
#include <cstddef>
#include <stdexcept>

namespace iog::lab {
namespace {

constexpr std::size_t kLineCharacters = 100;

bool is_digit(char letter) { return letter >= '0' && letter <= '9'; }

// Columns of a terminal: bytes that are not 10xxxxxx begin a character of UTF-8, and those of 0xCC
// and 0xCD (U+0300 to U+037F) stand on the character before them, such as the bar of a mean.
std::size_t width_of(std::string_view text) {
  return static_cast<std::size_t>(std::count_if(text.begin(), text.end(), [](char letter) {
    const auto byte = static_cast<unsigned char>(letter);
    return (byte & 0xC0U) != 0x80U && (byte & 0xFEU) != 0xCCU;
  }));
}

// Would a line that begins with this word be a list, a heading, a quotation or a table?
bool is_mark(std::string_view word) {
  const std::size_t digits = std::min(word.find_first_not_of("0123456789"), word.size());
  if (digits > 0) {
    return digits + 1 == word.size() && (word.back() == '.' || word.back() == ')');
  }
  return word[0] == '>' || word[0] == '|' ||
         word.find_first_not_of("-+*#=_") == std::string_view::npos;
}

// The pieces of a text between which a line may end. A word that would change the meaning of a line
// if it began one stays with the word before it.
std::vector<std::string> pieces_of(std::string_view text) {
  std::vector<std::string> pieces;
  while (!text.empty()) {
    const std::size_t begin = text.find_first_not_of(" \n");
    if (begin == std::string_view::npos) {
      break;
    }
    text.remove_prefix(begin);
    const std::string_view word = text.substr(0, text.find_first_of(" \n"));
    if (!pieces.empty() && is_mark(word)) {
      pieces.back().append(" ").append(word);
    } else {
      pieces.emplace_back(word);
    }
    text.remove_prefix(word.size());
  }
  return pieces;
}

// Lines of at most kLineCharacters, but for a single piece that is longer. `first` stands before
// the first line, as many spaces before the others.
std::string wrapped(std::string_view text, std::string_view first) {
  std::string lines(first);
  std::size_t column = first.size();
  for (const std::string& piece : pieces_of(text)) {
    const std::size_t width = width_of(piece);
    if (column > first.size() && column + 1 + width > kLineCharacters) {
      lines.append("\n").append(first.size(), ' ');
      column = first.size();
    } else if (column > first.size()) {
      lines += ' ';
      ++column;
    }
    lines += piece;
    column += width;
  }
  return lines + '\n';
}

// A bar would end the cell, a new line the table.
std::string cell_text(std::string_view text) {
  std::string cell;
  for (const char letter : text) {
    if (letter == '|') {
      cell += '\\';
    }
    cell += letter == '\n' ? ' ' : letter;
  }
  return cell;
}

// "-12.5", "4.65e-4", "1,048,576", "99.5 %", "66 Hz". A minus may be the typographic one.
bool is_number(std::string_view text) {
  for (const std::string_view sign : {"-", "+", "±", "−", "<", "≤", "≥"}) {
    if (text.starts_with(sign)) {
      text.remove_prefix(sign.size());
      break;
    }
  }
  if (text.empty() || !is_digit(text[0])) {
    return false;
  }
  text.remove_prefix(std::min(text.find_first_not_of("0123456789,."), text.size()));
  if (text.size() > 1 && text[0] == 'e') {
    text.remove_prefix(text[1] == '-' ? 2 : 1);
    text.remove_prefix(std::min(text.find_first_not_of("0123456789"), text.size()));
  }
  constexpr std::size_t kLongestUnit = 5;
  const bool has_unit = text.size() > 1 && text[0] == ' ' && width_of(text) <= 1 + kLongestUnit &&
                        text.find_first_of(" 0123456789", 1) == std::string_view::npos;
  return text.empty() || has_unit;
}

bool is_nothing(std::string_view text) { return text.empty() || text == "-" || text == "–"; }

using Row = std::vector<std::string>;

struct Column {
  std::size_t width = 3;
  bool is_right = false;
};

std::vector<Column> columns_of(const Row& head, const std::vector<Row>& rows) {
  std::vector<Column> columns(head.size());
  for (std::size_t i = 0; i < head.size(); ++i) {
    bool has_number = false;
    bool has_words = false;
    columns[i].width = std::max(columns[i].width, width_of(head[i]));
    for (const Row& row : rows) {
      columns[i].width = std::max(columns[i].width, width_of(row[i]));
      has_number = has_number || is_number(row[i]);
      has_words = has_words || (!is_number(row[i]) && !is_nothing(row[i]));
    }
    columns[i].is_right = has_number && !has_words;
  }
  // What is wider than a line is not made wider still by blanks behind its last words.
  std::size_t line = 1;
  for (const Column& column : columns) {
    line += column.width + 3;
  }
  if (line > kLineCharacters && !columns.back().is_right) {
    columns.back().width = width_of(head.back());
  }
  return columns;
}

std::string table_line(const Row& cells, const std::vector<Column>& columns) {
  std::string line = "|";
  for (std::size_t i = 0; i < cells.size(); ++i) {
    const std::size_t width = width_of(cells[i]);
    const std::string padding(std::max(columns[i].width, width) - width, ' ');
    line.append(" ");
    line.append(columns[i].is_right ? padding + cells[i] : cells[i] + padding).append(" |");
  }
  return line + '\n';
}

std::string rule_line(const std::vector<Column>& columns) {
  std::string line = "|";
  for (const Column& column : columns) {
    line.append(column.width + (column.is_right ? 1 : 2), '-');
    line.append(column.is_right ? ":|" : "|");
  }
  return line + '\n';
}

std::string printed(double value, std::chars_format format, int decimals) {
  std::array<char, 400> text{};  // the largest double has 309 digits before the point
  const auto result =
      std::to_chars(text.data(), text.data() + text.size(), value, format, decimals);
  return {text.data(), result.ptr};
}

// "-0.00" says nothing that "0.00" does not.
std::string without_negative_zero(std::string text) {
  const bool is_zero = text.find_first_of("123456789") == std::string::npos;
  if (is_zero && text.starts_with('-')) {
    text.erase(0, 1);
  }
  return text;
}

}  // namespace

void Markdown::begin(Block block) {
  if (!text_.empty() && !(block == Block::kItem && last_ == Block::kItem)) {
    text_ += '\n';
  }
  last_ = block;
}

void Markdown::title(std::string_view words) {
  begin(Block::kOther);
  text_.append("# ").append(words).append("\n");
}

void Markdown::heading(std::string_view words) {
  begin(Block::kOther);
  text_.append("## ").append(words).append("\n");
}

void Markdown::subheading(std::string_view words) {
  begin(Block::kOther);
  text_.append("### ").append(words).append("\n");
}

void Markdown::paragraph(std::string_view words) {
  begin(Block::kOther);
  text_ += wrapped(words, "");
}

void Markdown::item(std::string_view words) {
  begin(Block::kItem);
  text_ += wrapped(words, "- ");
}

void Markdown::table(const Row& columns, const std::vector<Row>& rows) {
  std::vector<Row> lines{columns};
  lines.insert(lines.end(), rows.begin(), rows.end());
  for (Row& line : lines) {
    if (line.size() != columns.size()) {
      throw std::invalid_argument("a table's row has another number of cells than its head");
    }
    std::transform(line.begin(), line.end(), line.begin(), cell_text);
  }
  const Row head = lines.front();
  lines.erase(lines.begin());
  const std::vector<Column> shape = columns_of(head, lines);
  begin(Block::kOther);
  text_ += table_line(head, shape) + rule_line(shape);
  for (const Row& line : lines) {
    text_ += table_line(line, shape);
  }
}

void Markdown::picture(std::string_view path, std::string_view caption) {
  begin(Block::kOther);
  text_ += wrapped("![" + std::string(caption) + "](" + std::string(path) + ")", "");
}

void Markdown::append(const Markdown& other) {
  begin(Block::kOther);
  text_ += other.text_;
  last_ = other.last_;
}

std::string fixed(double value, int decimals) {
  return without_negative_zero(printed(value, std::chars_format::fixed, decimals));
}

std::string scientific(double value, int decimals) {
  std::string text = without_negative_zero(printed(value, std::chars_format::scientific, decimals));
  const std::size_t e = text.find('e');
  if (e == std::string::npos) {
    return text;  // not finite
  }
  // "e+05" and "e-04" without what a reader skips.
  const std::size_t digits = std::min(text.find_first_not_of('0', e + 2), text.size() - 1);
  return text.substr(0, e + 1) + (text[e + 1] == '-' ? "-" : "") + text.substr(digits);
}

std::string percent(double share, int decimals) { return fixed(100 * share, decimals) + " %"; }

std::string grouped(double value) {
  const std::string digits = fixed(value, 0);
  const std::size_t first = digits.starts_with('-') ? 1 : 0;
  std::string text;
  for (std::size_t i = 0; i < digits.size(); ++i) {
    if (i > first && (digits.size() - i) % 3 == 0) {
      text += ',';
    }
    text += digits[i];
  }
  return text;
}

}  // namespace iog::lab
