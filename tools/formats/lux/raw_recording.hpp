// Recordings of raw messages, one file for each sensor, as the datagrams of a capture.
#pragma once

#include <string>
#include <vector>

#include "tools/formats/capture/datagram.hpp"
#include "tools/vehicles/vehicle_catalogue.hpp"

namespace iog::tools {

struct RawRecording {
  std::vector<CapturedDatagram> datagrams;
  std::string remark;  // what could not be used; empty if all was
};

// The file of that sensor: ibeo 0x2202 messages back to back for a LUX of any kind, payloads of
// 1206 bytes back to back for a Velodyne. Stamps are the messages' own times; a Velodyne knows only
// the time within the hour, the rest is that of 2024-05-01. UsageError if there is no such message
// in the file.
[[nodiscard]] RawRecording read_raw_recording(const std::string& path, const CatalogueEntry& car,
                                              std::size_t sensor);

}  // namespace iog::tools
