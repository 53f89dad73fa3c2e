#include "tools/frames/signed_stream.hpp"

#include <algorithm>
#include <utility>

#include "stream/channel.hpp"
#include "wire/byte_order.hpp"

namespace iog::tools {
namespace {

using authentication::MessageName;

constexpr std::uint16_t kSignatures = stream::kSignatureChannel.event.event_id;

}  // namespace

// By its message id (docs/spec.md 3.1).
bool SignedStream::claims_to_sign(std::span<const std::byte> datagram) {
  return datagram.size() >= 4 && wire::load_be16(datagram.first<2>()) == stream::kServiceId &&
         wire::load_be16(datagram.subspan<2, 2>()) == kSignatures;
}

void SignedStream::take(std::span<const std::byte> datagram, const Pass& pass) {
  if (claims_to_sign(datagram)) {
    take_signature(datagram, pass);
    return;
  }
  const MessageName name = authentication::name_of(datagram);
  if (const auto named = std::ranges::find(named_, name); named != named_.end()) {
    named_.erase(named);
    pass(datagram);
    return;
  }
  waiting_.push_back({.name = name,
                      .datagram = {datagram.begin(), datagram.end()},
                      .signatures_before = signatures_});
  if (waiting_.size() > kMostWaiting) {
    give_up_oldest();
  }
}

void SignedStream::take_signature(std::span<const std::byte> datagram, const Pass& pass) {
  const auto names = authentication::read_names(datagram);
  if (!names || !is_authentic(datagram, names->run)) {
    ++forged_;
    return;
  }
  ++signatures_;
  for (std::size_t i = 0; i < names->count(); ++i) {
    take_name((*names)[i], pass);
  }
  while (!waiting_.empty() && waiting_.front().signatures_before + kPatience < signatures_) {
    give_up_oldest();
  }
}

// A run is known from its first authentic signature on. Of the oldest one nothing is known when
// there are too many: a receiver that has seen so many runs drops it by its number all the same
// (RunWatch).
bool SignedStream::is_authentic(std::span<const std::byte> datagram, std::uint32_t run) {
  const auto known = runs_.find(run);
  if (known != runs_.end()) {
    return known->second.verify(datagram) == authentication::Verdict::kAuthentic;
  }
  authentication::Verifier verifier(key_, kSignatures, run);
  if (verifier.verify(datagram) != authentication::Verdict::kAuthentic) {
    return false;
  }
  runs_.emplace(run, verifier);
  order_of_runs_.push_back(run);
  if (order_of_runs_.size() > kMostRuns) {
    runs_.erase(order_of_runs_.front());
    order_of_runs_.pop_front();
  }
  return true;
}

void SignedStream::take_name(const MessageName& name, const Pass& pass) {
  const auto message = std::ranges::find(waiting_, name, &Waiting::name);
  if (message != waiting_.end()) {
    const std::vector<std::byte> datagram = std::move(message->datagram);
    waiting_.erase(message);
    pass(datagram);
    return;
  }
  named_.push_back(name);
  if (named_.size() > kMostNamed) {
    named_.pop_front();
  }
}

void SignedStream::give_up_oldest() {
  waiting_.pop_front();
  ++unsigned_;
}

void SignedStream::forget() {
  finish();
  named_.clear();
  runs_.clear();
  order_of_runs_.clear();
}

void SignedStream::finish() {
  while (!waiting_.empty()) {
    give_up_oldest();
  }
}

}  // namespace iog::tools
