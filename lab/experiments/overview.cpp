#include "lab/experiments/overview.hpp"

#include <algorithm>
#include <array>
#include <stdexcept>

namespace iog::lab {
namespace {

constexpr std::array kVerdicts{Verdict::kEquals, Verdict::kBeats, Verdict::kFallsShort,
                               Verdict::kDeparts};

// "Of 30 claims 20 are equal, 4 better, ..."
std::string counts_of(const std::vector<Claim>& claims) {
  std::string text;
  for (const Verdict verdict : kVerdicts) {
    const auto count = std::count_if(claims.begin(), claims.end(), [verdict](const Claim& claim) {
      return claim.verdict == verdict;
    });
    text.append(text.empty() ? "" : ", ").append(std::to_string(count)).append(" \"");
    text.append(word_of(verdict)).append("\"");
  }
  return std::to_string(claims.size()) + " claims, those about recordings included: " + text + ".";
}

// Set off if there is something to read about it.
std::string verdict_of(const Claim& claim) {
  const std::string word(word_of(claim.verdict));
  return claim.verdict == Verdict::kEquals ? word : "**" + word + "**";
}

}  // namespace

std::string_view word_of(Verdict verdict) {
  switch (verdict) {
    case Verdict::kEquals:
      return "equal";
    case Verdict::kBeats:
      return "better";
    case Verdict::kFallsShort:
      return "short of it";
    case Verdict::kDeparts:
      break;
  }
  return "departs";
}

void add_overview(Markdown& page, const std::vector<Claim>& claims) {
  std::vector<std::vector<std::string>> rows;
  for (const Claim& claim : claims) {
    if (claim.verdict != Verdict::kEquals && claim.reason.empty()) {
      throw std::invalid_argument("no reason is given for " + claim.place + ", " + claim.what);
    }
    rows.push_back(
        {claim.place, claim.what, claim.paper, claim.ours, verdict_of(claim), claim.reason});
  }
  page.heading("Overview");
  page.paragraph(
      "**equal**: the same, or within what the paper's own digits tell. **better**: on the side "
      "that "
      "the paper itself calls better. **short of it**: on the other side. **departs**: something "
      "else, on purpose or because the paper cannot be right.");
  page.paragraph(counts_of(claims));
  page.table({"place", "what", "paper", "here", "verdict", "reason"}, rows);
}

}  // namespace iog::lab
