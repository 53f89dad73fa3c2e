// A stream as a capture of its datagrams.
#pragma once

#include <string>

#include "tools/formats/capture/pcap_writer.hpp"
#include "tools/record/recording.hpp"

namespace iog::tools {

class PcapRecording : public Recording {
 public:
  // UsageError if the file cannot be written.
  explicit PcapRecording(const std::string& path) : file_(path) {}

  void keep_beginning() override { file_.keep_beginning(); }
  void take_datagram(const CapturedDatagram& datagram) override { file_.write(datagram); }
  void take_frame(const RecordedFrame& /*frame*/) override {}
  void finish(const Facts& /*facts*/) override { file_.finish(); }

 private:
  PcapWriter file_;
};

}  // namespace iog::tools
