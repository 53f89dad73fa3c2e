#include "pose/source.hpp"

#include "protection/believed.hpp"
#include "require/require.hpp"

namespace iog::pose {

Source::Source(const SourceDescription& description, std::uint32_t replayer_ipv4)
    : description_{description},
      replayer_ipv4_{replayer_ipv4},
      slicing_{description.log2_slice_ms} {
  require(description.is_valid());
}

Fate Source::receive(std::uint32_t source_ipv4, std::span<const std::byte> payload,
                     std::uint64_t arrival_us) {
  Fate fate = Fate::kStranger;
  if (protection::may_send(source_ipv4, description_.source_ipv4, replayer_ipv4_)) {
    const Decoded decoded = decode(payload);
    fate = decoded.fate == Fate::kUsed ? history_.take(decoded.message, arrival_us) : decoded.fate;
  }
  ++fates_[static_cast<std::size_t>(fate)];
  return fate;
}

Placed Source::place(const Slice& slice) {
  const Placed placed = history_.pose_at(slice.middle_us);
  const auto cause = static_cast<std::size_t>(placed.cause);
  ++slices_[cause];
  if (placed.cause != latest_) {
    ++spells_[cause].times;
    spells_[cause].since_us = slice.middle_us;
    latest_ = placed.cause;
  }
  return placed;
}

Tally Source::tally(Cause cause) const {
  const bool is_of_slices = cause == Cause::kLate || cause == Cause::kImprecise;
  return is_of_slices ? spells_[static_cast<std::size_t>(cause)] : history_.breaks(cause);
}

}  // namespace iog::pose
