#include "lab/scenarios/lossy_link.hpp"

#include <set>

#include "tools/frames/frame_assembler.hpp"
#include "tools/frames/live_grid.hpp"

namespace iog::lab {
namespace {

class LossyLink {
 public:
  LossyLink(const Harm& harm, std::uint64_t seed) : harm_(harm), random_(seed) {}

  // Messages leave one at each tick of a clock and arrive when it shows what they were given.
  void arrive_at(std::uint64_t time, Message message) {
    arrivals_.emplace(time, std::move(message));
  }

  void do_harm(std::uint64_t now, Message message) {
    if (happens(harm_.drop)) {
      return;
    }
    if (happens(harm_.duplicate)) {
      arrive_at(now + random_.below(60), message);
    }
    // Not asked where it cannot be, so that no other chance moves.
    if (harm_.repeat > 0 && happens(harm_.repeat)) {
      arrive_at(now + random_.below(4000), message);
    }
    if (happens(harm_.corrupt)) {
      for (std::uint64_t changes = 1 + random_.below(4); changes > 0; --changes) {
        message[random_.below(message.size())] ^= static_cast<std::byte>(1 + random_.below(255));
      }
    }
    now += happens(harm_.reorder) ? random_.below(20) : 0;
    now += happens(harm_.delay) ? random_.below(300) : 0;
    arrive_at(now, std::move(message));
  }

  [[nodiscard]] std::vector<Message> arrivals() {
    std::vector<Message> all;
    for (auto& [time, message] : arrivals_) {
      all.push_back(std::move(message));
    }
    return all;
  }

 private:
  [[nodiscard]] bool happens(unsigned percent) { return random_.below(100) < percent; }

  Harm harm_;
  tools::Random random_;
  std::multimap<std::uint64_t, Message> arrivals_;
};

// Tiles of the live grid that are not what they were in the frame that they are said to be of.
std::uint64_t wrong_tiles(const tools::LiveGrid& live, const SentStream& sent) {
  std::uint64_t wrong = 0;
  for (std::size_t tile = 0; tile < geometry::kTileCount; ++tile) {
    if (const auto age = live.age_of(tile)) {
      const SentStream::Name name{live.run_number(), live.newest_frame() - *age};
      const tools::GridFrame& truth = sent.frames.at(sent.by_name.at(name));
      wrong += tools::cells_of_tile(live.cells(), tile) != tools::cells_of_tile(truth.cells, tile)
                   ? 1U
                   : 0U;
    }
  }
  return wrong;
}

SentStream::Name name_of(const stream::Header& header) {
  return {header.run_number, header.frame_number};
}

// The frames are those of a receiver that knows of no other run.
void add_run(const std::vector<Message>& messages, bool breaks_off, SentStream& sent) {
  tools::FrameAssembler assembler([&](tools::GridFrame&& frame) {
    const auto number = static_cast<std::uint32_t>(sent.frames.size());
    sent.by_name.emplace(name_of(frame.header), number);
    sent.frames.push_back(std::move(frame));
  });
  for (const Message& message : messages) {
    assembler.take(message);
  }
  assembler.finish();
  std::size_t of_last_frame = 0;
  for (const Message& message : messages) {
    stream::Header header;
    std::span<const std::byte> body;
    static_cast<void>(stream::read_header(std::span(message).subspan(protection::kProtectionBytes),
                                          header, body));
    sent.messages.push_back(message);
    sent.frame_of.push_back(sent.by_name.at(name_of(header)));
    of_last_frame = sent.frame_of.back() + 1 == sent.frames.size() ? of_last_frame + 1 : 0;
  }
  const std::size_t sent_count = sent.messages.size() - (breaks_off ? of_last_frame / 2 : 0);
  sent.messages.resize(sent_count);
  sent.frame_of.resize(sent_count);
}

// Frames from `first` on before the first one from which on all are whole.
std::uint32_t frames_until_all_are_whole(const std::set<std::uint32_t>& whole, std::uint32_t first,
                                         std::uint32_t last) {
  std::uint32_t frame = last + 1;
  while (frame > first && whole.contains(frame - 1)) {
    --frame;
  }
  return frame - first;
}

}  // namespace

SentStream sent_stream(const std::vector<Message>& messages) {
  return sent_stream_of_runs({messages});
}

SentStream sent_stream_of_runs(const std::vector<std::vector<Message>>& runs) {
  SentStream sent;
  for (const std::vector<Message>& run : runs) {
    add_run(run, &run != &runs.back(), sent);
  }
  return sent;
}

std::vector<Message> carry(const SentStream& sent, const Harm& harm, std::uint32_t quiet_from,
                           std::uint64_t seed) {
  LossyLink link(harm, seed);
  for (std::size_t i = 0; i < sent.messages.size(); ++i) {
    if (sent.frame_of[i] < quiet_from) {
      link.do_harm(i, sent.messages[i]);
    } else {
      link.arrive_at(i, sent.messages[i]);
    }
  }
  return link.arrivals();
}

LinkTrial try_link(const SentStream& sent, const Harm& harm, std::uint32_t quiet_from,
                   std::uint64_t seed) {
  LinkTrial trial{.frames = quiet_from};
  tools::LiveGrid live;
  std::set<std::uint32_t> whole;
  std::uint32_t next = 0;
  tools::FrameAssembler assembler([&](const tools::GridFrame& frame) {
    live.take(frame);
    trial.wrong_tiles += wrong_tiles(live, sent);
    const std::uint32_t number = sent.by_name.at(name_of(frame.header));
    trial.old_frames += number < next ? 1U : 0U;
    next = number + 1;
    const bool is_whole = frame.is_whole() && tools::grid_crc_of(frame) == frame.end.grid_crc;
    if (is_whole) {
      whole.insert(number);
    }
    if (number < quiet_from) {
      trial.whole_frames += is_whole ? 1U : 0U;
      trial.tiles += geometry::kTileCount;
      trial.fresh_tiles += geometry::kTileCount - live.stale_tiles();
    }
  });
  for (const Message& message : carry(sent, harm, quiet_from, seed)) {
    assembler.take(message);
  }
  assembler.finish();
  trial.incomplete_after = frames_until_all_are_whole(
      whole, quiet_from, static_cast<std::uint32_t>(sent.frames.size() - 1));
  trial.corrupt_found =
      assembler.counts().corrupt + assembler.counts().not_ours + assembler.counts().other_version;
  trial.restarts = assembler.counts().restarts;
  trial.malformed = assembler.counts().malformed + assembler.counts().tiles_malformed;
  return trial;
}

}  // namespace iog::lab
