// What a client of `iog view --foxglove` may send: several requests, each ended by a zero.
// Laws: answers are few and are statuses; no channel that is not there has a subscription, and no
// two have the same.
#include <algorithm>
#include <nlohmann/json.hpp>
#include <set>
#include <string_view>
#include <vector>

#include "law.hpp"
#include "tools/foxglove/subscriptions.hpp"

namespace iog::fuzz {
namespace {

using tools::foxglove::Channel;
using tools::foxglove::Subscriptions;

constexpr int kMostRequests = 16;  // of an input

const std::vector<Channel> kChannels{
    {.id = 1, .topic = "/tf", .type = &tools::ros::kTfMessage},
    {.id = 2, .topic = "/grid", .type = &tools::ros::kOccupancyGrid},
    {.id = 30, .topic = "/objects", .type = &tools::ros::kSceneUpdate}};

void check_answers(const Subscriptions::Answers& answers) {
  law(answers.size() <= Subscriptions::kMostAnswers, "answers are few");
  for (const std::string& answer : answers) {
    law(nlohmann::json::parse(answer)["op"] == "status", "an answer is a status");
  }
}

}  // namespace

void check(std::span<const std::byte> input) {
  Subscriptions subscriptions;
  check_answers(Subscriptions::take_binary(input));
  std::string_view rest(reinterpret_cast<const char*>(input.data()), input.size());
  for (int number = 0; number < kMostRequests && !rest.empty(); ++number) {
    const std::string_view request = rest.substr(0, rest.find('\0'));
    rest.remove_prefix(std::min(rest.size(), request.size() + 1));
    check_answers(subscriptions.take_text(request, kChannels));
    std::set<std::uint32_t> ids;
    std::size_t count = 0;
    for (const Channel& channel : kChannels) {
      if (const auto id = subscriptions.of_channel(channel.id)) {
        ids.insert(*id);
        ++count;
      }
    }
    law(ids.size() == count, "no two have the same id");
    law(subscriptions.is_empty() == (count == 0), "there are no others");
  }
}

}  // namespace iog::fuzz
