#include "map/layer.hpp"

namespace iog::map {
namespace {

constexpr window::TileRuledOut kAnywhere{};

}  // namespace

void Layer::work(const Block* block, const std::optional<pose::MapTransform>& transform,
                 perception::WindowFusion& window) {
  ++frame_;
  take_inputs(block, transform, window);
  const Cause cause = cause_of(block, window.view().is_centred());
  if (cause == Cause::kNone) {
    find_stale(*block, window);
    judge(window);
    budget_ = kWorkPerFrame;
    draw_waiting(*block, window);
    report_.work = kWorkPerFrame - budget_;
  } else if (cause != Cause::kNoPlace) {
    withdraw_all(window);
  }
  report_.tiles_drawn = counts_[static_cast<std::size_t>(State::kDrawn)];
  report_.tiles_outside = counts_[static_cast<std::size_t>(State::kOutside)];
  report_.tiles_waiting = counts_[static_cast<std::size_t>(State::kWaiting)];
  report_cause(cause);
}

void Layer::look(const Block* block, const std::optional<pose::MapTransform>& transform,
                 const perception::WindowFusion& window) {
  take_inputs(block, transform, window);
  report_cause(cause_of(block, window.view().is_centred()));
}

void Layer::report_cause(Cause cause) {
  const bool is_outside = report_.tiles_outside == tiles_;
  if (cause == Cause::kNone && (is_outside || agreement_.is_contradicted())) {
    cause = is_outside ? Cause::kOutside : Cause::kContradicted;
  }
  begin(cause);
}

void Layer::take_inputs(const Block* block, const std::optional<pose::MapTransform>& transform,
                        const perception::WindowFusion& window) {
  cell_mm_ = window.cell_mm();
  tiles_ = window.view().area().extent().tile_count();
  report_.crc = block == nullptr ? 0 : block->crc();
  report_.origin = block == nullptr ? 0 : block->origin();
  report_.transform = transform;
  report_.radius = 0;
  report_.tiles_finished = 0;
  report_.tiles_withdrawn = 0;
  report_.work = 0;
  if (block != nullptr && transform) {
    const std::uint32_t radius =
        blur_radius(block->accuracy_mm(), transform->sigma, static_cast<std::uint32_t>(cell_mm_));
    report_.radius = radius <= kHalo ? static_cast<std::uint8_t>(radius) : 0;
    now_ = {.local_frame = transform->local_frame, .radius = report_.radius};
  }
}

Cause Layer::cause_of(const Block* block, bool is_centred) const {
  if (block == nullptr) {
    return Cause::kNoMap;
  }
  if (!report_.transform) {
    return Cause::kNoTransform;
  }
  if (report_.transform->origin != report_.origin) {
    return Cause::kOtherOrigin;
  }
  if (report_.transform->sigma.position_mm > kMaxSigmaMm) {
    return Cause::kImprecise;
  }
  if (report_.radius == 0) {
    return Cause::kBlurred;
  }
  return is_centred ? Cause::kNone : Cause::kNoPlace;
}

void Layer::begin(Cause cause) {
  if (cause != report_.cause || frame_ == 1) {
    ++report_.begun[static_cast<std::size_t>(cause)];
  }
  report_.cause = cause;
}

// If nothing changes, no tile needs a check. A finished tile was not stale in the previous frame,
// and stays valid while the transform and the blur do.
void Layer::find_stale(const Block& block, perception::WindowFusion& window) {
  const window::Area area = window.view().area();
  const bool is_other_map = !is_in_use_ || block.crc() != crc_;
  const bool is_other_basis = now_ != basis_;
  drop_stale_drawing(area, is_other_map || block.data() != data_);
  if (is_other_map && block.crc() != crc_) {
    agreement_ = {};
  }
  if (is_other_map || area.corner() != area_.corner() || is_other_basis) {
    for (std::size_t slot = 0; slot < window::kSlotCount; ++slot) {
      const window::TileNumber tile = area.tile_at(slot);
      if (!area.contains(tile)) {
        withdraw(slot, State::kIdle, window);
        continue;
      }
      if (states_[slot] == State::kIdle || tile != area_.tile_at(slot) ||
          (is_done(slot) && (is_other_map || (is_other_basis && is_stale(bases_[slot], tile))))) {
        since_[slot] = frame_;
        withdraw(slot, State::kWaiting, window);
      }
    }
  }
  area_ = area;
  basis_ = now_;
  crc_ = block.crc();
  data_ = block.data();
  is_in_use_ = true;
}

void Layer::drop_stale_drawing(const window::Area& area, bool is_of_other_bytes) {
  if (unfinished_) {
    const window::TileNumber tile = area_.tile_at(unfinished_->slot);
    if (is_of_other_bytes || !area.contains(tile) || area.tile_at(unfinished_->slot) != tile ||
        is_stale(unfinished_->basis, tile)) {
      unfinished_.reset();
    }
  }
}

bool Layer::is_stale(const Basis& basis, window::TileNumber tile) const {
  return basis.radius < now_.radius ||
         (basis.local_frame != now_.local_frame &&
          has_moved(tile, basis.local_frame, now_.local_frame, cell_mm_));
}

void Layer::withdraw(std::size_t slot, State next, perception::WindowFusion& window) {
  if (states_[slot] == State::kDrawn && !agreement_.is_contradicted()) {
    window.rule_out(slot, kAnywhere);
    ++report_.tiles_withdrawn;
  }
  set_state(slot, next);
}

void Layer::withdraw_all(perception::WindowFusion& window) {
  for (std::size_t slot = 0; is_in_use_ && slot < window::kSlotCount; ++slot) {
    withdraw(slot, State::kIdle, window);
  }
  unfinished_.reset();
  is_in_use_ = false;
}

// Uses the cells as they were before the frame. If the map is contradicted, its classes are revoked
// at once. To restore them, each tile is drawn again.
void Layer::judge(perception::WindowFusion& window) {
  const window::WindowView view = window.view();
  for (std::size_t slot = frame_ % kRoundFrames; slot < window::kSlotCount; slot += kRoundFrames) {
    if (states_[slot] == State::kDrawn && view.is_known(slot)) {
      agreement_.add(view.tile(slot).found.freed, inside_buildings_[slot]);
    }
  }
  if (frame_ % kRoundFrames != kRoundFrames - 1) {
    return;
  }
  Agreement next = agreement_;
  next.end_round(cell_mm_);
  if (next.is_contradicted() != agreement_.is_contradicted()) {
    for (std::size_t slot = 0; slot < window::kSlotCount; ++slot) {
      if (states_[slot] == State::kDrawn) {
        since_[slot] = frame_;
        withdraw(slot, next.is_contradicted() ? State::kDrawn : State::kWaiting, window);
      }
    }
  }
  agreement_ = next;
}

void Layer::set_state(std::size_t slot, State state) {
  --counts_[static_cast<std::size_t>(states_[slot])];
  ++counts_[static_cast<std::size_t>(state)];
  states_[slot] = state;
  waiting_.set(slot, state == State::kWaiting);
}

void Layer::draw_waiting(const Block& block, perception::WindowFusion& window) {
  while (budget_ > 0 && counts_[static_cast<std::size_t>(State::kWaiting)] > 0) {
    const std::uint32_t since = oldest();
    for (std::size_t slot = waiting_.first_from(0); slot < window::kSlotCount && budget_ > 0;
         slot = waiting_.first_from(slot + 1)) {
      if (since_[slot] == since) {
        draw(block, slot, window);
      }
    }
  }
}

// The frame in which the longest waiting tiles began to wait. Frame numbers wrap.
std::uint32_t Layer::oldest() const {
  std::uint32_t most = 0;
  for (std::size_t slot = waiting_.first_from(0); slot < window::kSlotCount;
       slot = waiting_.first_from(slot + 1)) {
    most = std::max(most, frame_ - since_[slot]);
  }
  return frame_ - most;
}

// An unfinished tile is always the first that waits, because no other tile can overtake it.
void Layer::draw(const Block& block, std::size_t slot, perception::WindowFusion& window) {
  if (!unfinished_ || unfinished_->slot != slot) {
    const TilePlace place(now_.local_frame, area_.tile_at(slot), cell_mm_);
    if (TileDrawing::is_outside(block, place, now_.radius)) {
      spend(kWorkPerTileOutside);
      finish(slot, State::kOutside, now_);
      return;
    }
    spend(kWorkPerTile);
    unfinished_.emplace(slot, now_, block, place);
  }
  if (unfinished_->drawing.go_on(budget_)) {
    const TileMask mask = unfinished_->drawing.mask();
    inside_buildings_[slot] = inside_buildings(mask);
    if (!agreement_.is_contradicted()) {
      rule_out(mask, ruled_out_);
      window.rule_out(slot, ruled_out_);
    }
    finish(slot, State::kDrawn, unfinished_->basis);
    unfinished_.reset();
  }
}

void Layer::finish(std::size_t slot, State state, const Basis& basis) {
  bases_[slot] = basis;
  set_state(slot, state);
  ++report_.tiles_finished;
}

}  // namespace iog::map
