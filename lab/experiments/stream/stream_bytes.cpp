#include "lab/experiments/stream/stream_bytes.hpp"

#include <memory>
#include <optional>
#include <span>

#include "protection/protected_message.hpp"
#include "stream/tiles.hpp"
#include "tools/formats/capture/pcap_reader.hpp"
#include "tools/frames/frame_assembler.hpp"
#include "tools/fuse/offline_target.hpp"
#include "tools/simulate/drives/drive.hpp"

namespace iog::lab {
namespace {

std::size_t index_of(tile_coding::Encoding encoding) { return static_cast<std::size_t>(encoding); }

class Scale {
 public:
  void take(std::span<const std::byte> message) {
    weigh_message(message);
    assembler_.take(message);
  }

  [[nodiscard]] const StreamBytes& bytes() const { return bytes_; }

 private:
  void weigh_message(std::span<const std::byte> message) {
    stream::Header header;
    std::span<const std::byte> body;
    const auto content = message.subspan(protection::kProtectionBytes);
    if (stream::read_header(content, header, body) != stream::ReadStatus::kOk ||
        !header.has_evidence()) {
      return;
    }
    ++bytes_.messages;
    bytes_.bytes += message.size();
    stream::TilesHeader tiles;
    stream::TileRecords records;
    if (header.type != stream::MessageType::kTiles ||
        stream::read_tiles(body, tiles, records) != stream::ReadStatus::kOk) {
      return;
    }
    for (stream::TileRecord record; records.next(record);) {
      ++bytes_.sent_tiles.at(index_of(record.encoding));
      bytes_.sent_bytes.at(index_of(record.encoding)) += record.payload.size();
    }
  }

  void weigh_grid(const tools::GridFrame& frame) {
    if (!frame.header.has_evidence()) {
      return;
    }
    ++bytes_.frames;
    for (std::size_t tile = 0; tile < geometry::kTileCount; ++tile) {
      if (!frame.known_tiles.test(tile)) {
        continue;
      }
      ++bytes_.tiles;
      bytes_.bytes_alone +=
          encoder_->encode(tools::cells_of_tile(frame.cells, tile), 0, std::nullopt, payload_)
              .bytes;
    }
  }

  StreamBytes bytes_;
  std::unique_ptr<tile_coding::Encoder> encoder_ = std::make_unique<tile_coding::Encoder>();
  std::array<std::byte, tile_coding::kTileBytes> payload_{};
  tools::FrameAssembler assembler_{[this](const tools::GridFrame& frame) { weigh_grid(frame); }};
};

void play(const tools::CatalogueEntry& car, const Feed& feed,
          const tools::MessageHandler& on_message) {
  vehicle::Vehicle vehicle = *car.vehicle;
  vehicle.grids = vehicle::Grids::kIndexes;
  const auto target = std::make_unique<tools::OfflineTarget>(vehicle, on_message);
  feed([&](const tools::CapturedDatagram& datagram) { static_cast<void>(target->take(datagram)); });
  target->finish();
}

}  // namespace

StreamBytes weigh_stream(const tools::CatalogueEntry& car, const Feed& feed) {
  Scale scale;
  play(car, feed, [&](std::span<const std::byte> message) { scale.take(message); });
  return scale.bytes();
}

std::vector<std::vector<std::byte>> messages_of(const tools::CatalogueEntry& car,
                                                const Feed& feed) {
  std::vector<std::vector<std::byte>> messages;
  play(car, feed, [&](std::span<const std::byte> message) {
    messages.emplace_back(message.begin(), message.end());
  });
  return messages;
}

Feed feed_of_drive(const tools::CatalogueEntry& car, std::string_view scene, std::uint64_t seed,
                   std::uint32_t seconds) {
  return [&car, scene, seed, seconds](const auto& take) {
    tools::Drive drive(car, seed, seconds, tools::find_scene(scene));
    for (std::uint32_t frame = 0; frame < drive.frame_count(); ++frame) {
      for (const tools::CapturedDatagram& datagram : drive.datagrams(frame)) {
        take(datagram);
      }
    }
  };
}

Feed feed_of_recording(const std::string& pcap) {
  return [pcap](const auto& take) {
    tools::PcapReader reader(pcap);
    while (const auto datagram = reader.next()) {
      take(*datagram);
    }
  };
}

}  // namespace iog::lab
