#include "tools/foxglove/frame_messages.hpp"

#include <algorithm>
#include <utility>

namespace iog::tools::foxglove {
namespace {

auto rank_of(std::string_view topic) { return std::ranges::find(kAllTopics, topic); }

}  // namespace

FrameMessages::Changes FrameMessages::take(std::shared_ptr<const LiveFrame> frame) {
  if (!frame || (frame_ && frame->number == frame_->number)) {
    return {};
  }
  changes_ = {};
  const std::uint32_t vehicle_id = frame->frame.header.vehicle_id;
  if (vehicle_id_ != vehicle_id) {
    changes_.gone = std::exchange(channels_, {});
    vehicle_id_ = vehicle_id;
  }
  frame_ = std::move(frame);
  made_.clear();
  missing_.clear();
  pass();
  return std::move(changes_);
}

std::vector<ChannelMessage> FrameMessages::of_channels(const std::set<std::uint32_t>& wanted) {
  std::vector<ChannelMessage> messages;
  if (!frame_) {
    return messages;
  }
  missing_.clear();
  for (const std::uint32_t channel : wanted) {
    if (made_.try_emplace(channel).second) {
      missing_.insert(channel);
    }
  }
  if (!missing_.empty()) {
    pass();
  }
  for (const Channel& channel : channels_) {
    if (wanted.contains(channel.id)) {
      std::ranges::copy(made_.at(channel.id), std::back_inserter(messages));
    }
  }
  return messages;
}

void FrameMessages::pass() {
  for (const CapturedDatagram& datagram : frame_->datagrams) {
    messages_.take_datagram(datagram);
  }
  messages_.take_frame(frame_->recorded());
}

bool FrameMessages::wants(std::string_view topic, const ros::MessageType& type) {
  if (std::ranges::find(channels_, topic, &Channel::topic) == channels_.end()) {
    const Channel channel{.id = ++last_id_, .topic = topic, .type = &type};
    channels_.push_back(channel);
    std::ranges::sort(channels_, {}, [](const Channel& each) { return rank_of(each.topic); });
    changes_.added.push_back(channel);
  }
  return missing_.contains(id_of(topic));
}

void FrameMessages::take(std::string_view topic, const ros::MessageType& /*type*/,
                         const MessageTimes& times, std::vector<std::byte> message) {
  const std::uint32_t id = id_of(topic);
  made_[id].push_back(
      {.channel = id,
       .arrival_ns = times.arrival_us * 1000,
       .bytes = std::make_shared<const std::vector<std::byte>>(std::move(message))});
}

std::uint32_t FrameMessages::id_of(std::string_view topic) const {
  return std::ranges::find(channels_, topic, &Channel::topic)->id;
}

}  // namespace iog::tools::foxglove
