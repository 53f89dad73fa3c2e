// The network sink for frames with classes. Between a frame's tiles and its end message, the sink
// sends the class tiles, the class end message and the objects.
#pragma once

#include <cstddef>
#include <span>

#include "app/network_sink.hpp"
#include "app/reception_log.hpp"
#include "stream/class_end.hpp"
#include "stream/class_hash.hpp"
#include "stream/message.hpp"
#include "stream/objects.hpp"
#include "stream/receptions.hpp"
#include "window/window_view.hpp"

namespace iog::app {

// A PerceptionSink contains 4.6 MB of sent and encoded tiles, so it must be in static memory.
template <Platform P>
class PerceptionSink : private NetworkSink<P> {
  using Indexes = NetworkSink<P>;

 public:
  // `platform` must outlive this object.
  PerceptionSink(P& platform, Coding coding, const geometry::Grid& grid = {})
      : Indexes(platform, coding, grid), classes_(platform, this->messages(), coding, grid) {}

  using Indexes::begin_frame;
  using Indexes::end;
  using Indexes::tile_place;

  // Callers must fill in the class end message, class_end(), before the classes are encoded, and
  // objects() before the objects are sent.
  [[nodiscard]] stream::ClassEnd& class_end() { return class_end_; }
  [[nodiscard]] stream::ObjectList& objects() { return objects_; }

  // The cells must not change until the frame ends.
  void take_tile(std::size_t tile, tile_coding::TileCells cells) {
    if (this->header().has_indexes()) {
      Indexes::take_staying(tile, cells);
    }
  }

  // `encode_tiles()`, `encode_classes()` and `send_classes()` are the three steps of sending a
  // frame. The cores share the work of the first two steps. Core 0 also runs do_beside() during
  // encode_tiles(). During encode_classes(), core 0 sends the tile messages and the first part of
  // the classes.
  template <typename DoBeside>
  void encode_tiles(DoBeside do_beside) {
    Indexes::encode_tiles(do_beside);
  }
  void encode_classes(const window::WindowView& classes) {
    const window::Area& area = classes.area();
    classes_.begin(this->header(), class_end_.window, area.extent());
    if (!classes_.do_wait()) {
      end_indexes();
    }
    area.for_each_tile([&](std::size_t number, window::TileNumber tile) {
      const std::size_t slot = window::slot_of(tile);
      if (const auto cells = classes.known_bytes(slot)) {
        classes_.add_classes(number, *cells, classes.age_frames(slot), classes.version(slot));
      }
    });
    if (classes_.do_wait()) {
      classes_.encode_in_two([this] { end_indexes(); });
    }
  }
  void send_classes() {
    const auto sent = classes_.finish_encoded();
    class_end_.tiles_sent = sent.tiles;
    class_end_.tiles_lost = sent.tiles_lost;
    class_end_.classes_crc = sent.crc;
    this->messages().send(
        this->header(), stream::MessageType::kClassEnd,
        [this](std::span<std::byte> body) { return stream::write_class_end(class_end_, body); });
  }

  // Runs all three steps.
  void take_classes(const window::WindowView& classes) {
    Indexes::encode_rest();
    encode_classes(classes);
    send_classes();
  }

  // Call this function only if the header states that the frame has objects.
  void send_objects() {
    for (std::size_t part = 0; part < stream::parts_of(objects_); ++part) {
      this->messages().send(
          this->header(), stream::MessageType::kObjects,
          [&](std::span<std::byte> body) { return stream::write_objects(objects_, part, body); });
    }
  }

  void send_receptions(const ReceptionLog& log) {
    for (std::size_t part = 0; part < stream::reception_parts_of(log.all().size()); ++part) {
      this->messages().send(
          this->header(), stream::MessageType::kReceptions, [&](std::span<std::byte> body) {
            return stream::write_receptions(log.all(), log.not_listed(), part, body);
          });
    }
  }

  // Ends both grids.
  void end_frame() { this->send_frame_end(); }

 private:
  void end_indexes() {
    if (this->header().has_indexes()) {
      this->end_encoded_tiles();
    }
  }

  stream::ClassEnd class_end_;
  TileSender<P, stream::ClassHash> classes_;
  stream::ObjectList objects_;
};

}  // namespace iog::app
