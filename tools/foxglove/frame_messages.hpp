// The messages of the newest frame. Each is made when the first client that wants it can take it,
// once for all of them.
#pragma once

#include <cstddef>
#include <cstdint>
#include <map>
#include <memory>
#include <optional>
#include <set>
#include <span>
#include <string_view>
#include <vector>

#include "tools/foxglove/live_feed.hpp"
#include "tools/foxglove/protocol.hpp"
#include "tools/record/topic_messages.hpp"

namespace iog::tools::foxglove {

// A message of a channel, serialised. Clients share its bytes.
struct ChannelMessage {
  std::uint32_t channel = 0;
  std::uint64_t arrival_ns = 0;
  std::shared_ptr<const std::vector<std::byte>> bytes;
};

class FrameMessages : private TopicSink {
 public:
  // Stamps are of this PC's clock, as all that somebody looks at now.
  FrameMessages() : messages_(*this, Stamp::kArrival) {}

  // Changes of the channels by a frame. There is a channel for each topic that the stream has had
  // something for; those of a vehicle end with the first frame of another one.
  struct Changes {
    std::vector<Channel> gone;
    std::vector<Channel> added;
  };

  // The next frame. Nothing changes if it is the same as before.
  Changes take(std::shared_ptr<const LiveFrame> frame);

  // In the order of kAllTopics.
  [[nodiscard]] std::span<const Channel> channels() const { return channels_; }
  // 0: none has come.
  [[nodiscard]] std::uint64_t frame_number() const { return frame_ ? frame_->number : 0; }

  // The newest frame's messages of these channels, those of a channel together, channels in the
  // order as above.
  [[nodiscard]] std::vector<ChannelMessage> of_channels(const std::set<std::uint32_t>& wanted);

 private:
  [[nodiscard]] bool wants(std::string_view topic, const ros::MessageType& type) override;
  void take(std::string_view topic, const ros::MessageType& type, const MessageTimes& times,
            std::vector<std::byte> message) override;
  // Goes over all topics of the frame.
  void pass();
  [[nodiscard]] std::uint32_t id_of(std::string_view topic) const;

  TopicMessages messages_;
  std::shared_ptr<const LiveFrame> frame_;
  std::optional<std::uint32_t> vehicle_id_;
  std::uint32_t last_id_ = 0;
  std::vector<Channel> channels_;
  Changes changes_;
  std::set<std::uint32_t> missing_;                            // that a pass is to make
  std::map<std::uint32_t, std::vector<ChannelMessage>> made_;  // of the frame, by channel
};

}  // namespace iog::tools::foxglove
