// The management bus of the PHY, with the frames of IEEE 802.3 clause 22. The controller must have
// a 32-bit register that contains a frame without its preamble. A port starts a frame and reports
// the frame's result.
#pragma once

#include <cstdint>
#include <optional>

#include "board/common/ethernet/clause_22.hpp"

namespace iog::board {

template <typename Port>
class Mdio {
 public:
  explicit Mdio(typename Port::Registers& registers) : port_(registers) {}

  // Sets the bus clock to at most 2.5 MHz (IEEE 802.3). Also call this function after a reset of
  // the controller. The reset ends a started access.
  void start() { port_.start(); }

  // Sets the PHY address, 0 to 31, of all further accesses.
  void select(unsigned phy_address) { phy_address_ = phy_address; }

  // Selects the first PHY that answers at one of these addresses. All waits are bounded.
  phy::Identity find(unsigned first_address, unsigned last_address) {
    for (unsigned address = first_address; address <= last_address; ++address) {
      select(address);
      const std::uint32_t high = read(phy::kIdHigh).value_or(0xffff);
      const std::uint32_t low = read(phy::kIdLow).value_or(0xffff);
      const std::uint32_t id = high << 16 | low;
      if (id != 0 && id != phy::Identity::kNobody) {  // 0: the wire is held low
        return {.address = address, .id = id};
      }
    }
    return {};
  }

  // Reads a register and waits for the result, for a bounded time. Use this function only during
  // start-up.
  std::optional<std::uint16_t> read(unsigned phy_register) {
    begin_read(phy_register);
    if (!wait()) {
      return std::nullopt;
    }
    return result();
  }
  bool write(unsigned phy_register, std::uint16_t value) {
    port_.begin(frame(kWrite, phy_register) | value);
    return wait();
  }

  // Call this function only after find() has found the PHY. Failures are ignored, because start-up
  // cannot correct failures. After a failed write, the link stays down or loses frames.
  void set(unsigned phy_register, std::uint16_t value) {
    static_cast<void>(write(phy_register, value));
  }

  // The loop reads a register in steps that do not wait.
  void begin_read(unsigned phy_register) { port_.begin(frame(kRead, phy_register)); }
  bool finished() const { return port_.finished(); }
  std::uint16_t result() const { return port_.data(); }

 private:
  static constexpr std::uint32_t kRead = 2u << 28;   // OP = 10
  static constexpr std::uint32_t kWrite = 1u << 28;  // OP = 01

  // ST = 01, TA = 10 (802.3 clause 22.2.4.5)
  std::uint32_t frame(std::uint32_t operation, unsigned phy_register) const {
    return 1u << 30 | operation | phy_address_ << 23 | phy_register << 18 | 2u << 16;
  }

  bool wait() const {
    for (unsigned polls = 0; polls < Port::kMaxPolls; ++polls) {
      if (finished()) {
        return true;
      }
    }
    return false;
  }

  Port port_;
  unsigned phy_address_ = 0;
};

}  // namespace iog::board
