#include "pose/source.hpp"

#include "protection/believed.hpp"
#include "require/require.hpp"

namespace iog::pose {

Source::Source(const SourceDescription& description, std::uint32_t replayer_ipv4,
               bool depends_on_arrival)
    : description_{description},
      replayer_ipv4_{replayer_ipv4},
      slicing_{description.log2_slice_ms},
      history_{depends_on_arrival} {
  require(description.is_valid());
}

Fate Source::receive(std::uint32_t source_ipv4, std::span<const std::byte> payload,
                     std::uint64_t arrival_us) {
  Fate fate = Fate::kStranger;
  if (protection::may_send(source_ipv4, description_.source_ipv4, replayer_ipv4_)) {
    const Decoded decoded = decode(payload);
    fate = decoded.fate == Fate::kUsed ? history_.add(decoded.message, arrival_us) : decoded.fate;
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

CauseCounts Source::cause_counts() const {
  CauseCounts counts{.slices = slices_};
  for (std::size_t cause = 0; cause < kCauseCount; ++cause) {
    counts.began[cause] = tally(static_cast<Cause>(cause));
  }
  return counts;
}

std::uint8_t CauseCounts::since(const CauseCounts& before) const {
  unsigned causes = 0;
  for (std::size_t cause = 1; cause < kCauseCount; ++cause) {
    const bool is_met =
        began[cause].times != before.began[cause].times || slices[cause] != before.slices[cause];
    causes |= is_met ? 1U << cause : 0U;
  }
  return static_cast<std::uint8_t>(causes);
}

}  // namespace iog::pose
