// What a host has sent, and what it should have.
#pragma once

#include <gtest/gtest.h>
#include <string>

#include "net/ethernet.hpp"
#include "net/station.hpp"

namespace iog::net::testing {

// What was sent since the last look, which is one frame.
inline Frame only_sent(Station& station) {
  const auto sent = station.port.take_sent();
  EXPECT_EQ(sent.size(), 1U);
  return sent.empty() ? Frame(kMinFrameBytes) : sent[0];
}

// By ARP (RFC 826): 0001 asks, 0002 answers.
inline Frame our_arp(const std::string& to, const std::string& operation,
                     const std::string& target) {
  Frame frame = from_hex(to + "02000000000f 0806 0001 0800 06 04" + operation +
                         "02000000000f 0a00020f" + target);
  frame.resize(kMinFrameBytes);
  return frame;
}

}  // namespace iog::net::testing
