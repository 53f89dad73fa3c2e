#include <filesystem>
#include <optional>

#include "tools/formats/capture/capture_set.hpp"
#include "tools/identity/capture_identity.hpp"
#include "tools/program/exit_status.hpp"
#include "tools/program/joined.hpp"

namespace iog::tools {

void demand_fit(const std::vector<std::string>& paths, const CatalogueEntry& car) {
  for (const std::string& path : paths) {
    std::error_code ignored;
    if (path == "-" || (std::filesystem::exists(path, ignored) &&
                        !std::filesystem::is_regular_file(path, ignored))) {
      return;
    }
  }
  CaptureSet capture(paths);
  CaptureIdentity identity;
  while (!identity.is_settled(car)) {
    const std::optional<CapturedDatagram> datagram = capture.next();
    if (!datagram) {
      break;
    }
    identity.add(*datagram);
  }
  const std::string refusal = identity.refusal(car);
  if (!refusal.empty()) {
    std::vector<std::string> skipped;
    for (const CaptureSet::File& file : capture.files()) {
      if (const std::string words = describe_skipped(file.reader->counts()); !words.empty()) {
        skipped.push_back(words);
      }
      if (!file.reader->trouble().empty()) {
        skipped.push_back("the file " + file.reader->trouble());
      }
    }
    throw UsageError(joined(paths, ", ") + ": " + refusal +
                     (skipped.empty() ? "" : " (" + joined(skipped, "; ") + ")"));
  }
}

}  // namespace iog::tools
