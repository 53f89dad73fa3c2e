// The state of a channel, from the checks of its messages: the E2E state machine of AUTOSAR
// (PRS_E2EProtocol, section "Specification of E2E state machine"; one window size for all states,
// as in SWS E2ELibrary 4.2.2).
//
// One check may fail by chance, so a receiver judges its sender by the last few. Of the last
// `window` checks it counts the usable ones and those that found an error. Repeated messages, wrong
// sequences and missing data are neither.
//
//   from      to        when
//   no data   init      a check that was neither an error nor without new data; it is not counted
//   init      valid     enough usable (min_ok) and few errors (max_errors)
//   init      invalid   too many errors
//   valid     invalid   too many errors, or too few usable
//   invalid   valid     enough usable and few errors
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>

#include "protection/profile4.hpp"

namespace iog::protection {

enum class ChannelState : std::uint8_t { kNoData, kInit, kValid, kInvalid };

struct Supervision {
  // What a state demands of the window: init and invalid to change to valid, valid to stay so.
  struct Limits {
    std::uint8_t min_ok;
    std::uint8_t max_errors;
  };

  static constexpr std::size_t kMaxWindow = 32;

  std::uint8_t window;  // checks
  Limits init;
  Limits valid;
  Limits invalid;

  // The constraints of the standard. To become valid is at least as hard as to stay valid.
  [[nodiscard]] constexpr bool is_valid() const {
    return window <= kMaxWindow && valid.min_ok >= 1 && valid.min_ok <= init.min_ok &&
           init.min_ok <= invalid.min_ok && valid.max_errors >= init.max_errors &&
           init.max_errors >= invalid.max_errors && fits(init) && fits(valid) && fits(invalid);
  }

 private:
  [[nodiscard]] constexpr bool fits(const Limits& limits) const {
    return limits.min_ok + limits.max_errors <= window;
  }
};

class Supervisor {
 public:
  // supervision.is_valid()
  constexpr explicit Supervisor(const Supervision& supervision) : supervision_{supervision} {
    checks_.fill(CheckStatus::kNoNewData);
  }

  // After each check; kNoNewData after each period in which nothing came.
  ChannelState update(CheckStatus status);

  [[nodiscard]] ChannelState state() const { return state_; }

 private:
  [[nodiscard]] ChannelState next_state(CheckStatus status);

  Supervision supervision_;
  ChannelState state_ = ChannelState::kNoData;
  std::array<CheckStatus, Supervision::kMaxWindow> checks_{};  // a ring, `window` of them
  std::size_t oldest_ = 0;
};

}  // namespace iog::protection
