#include "tools/identity/vehicle_fit.hpp"

#include <filesystem>
#include <optional>

#include "tools/formats/capture/pcap_reader.hpp"
#include "tools/identity/capture_identity.hpp"
#include "tools/program/exit_status.hpp"

namespace iog::tools {

void demand_fit(const std::string& path, const CatalogueEntry& car) {
  std::error_code ignored;
  if (std::filesystem::exists(path, ignored) && !std::filesystem::is_regular_file(path, ignored)) {
    return;
  }
  PcapReader capture(path);
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
    const std::string skipped = describe_skipped(capture.counts());
    throw UsageError(path + ": " + refusal + (skipped.empty() ? "" : " (" + skipped + ")"));
  }
}

}  // namespace iog::tools
