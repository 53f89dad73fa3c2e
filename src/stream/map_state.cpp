#include "stream/map_state.hpp"

#include <algorithm>

#include "pose/wire_format.hpp"

namespace iog::stream {
namespace {

constexpr std::size_t kFixedBytes = 72;
constexpr std::uint8_t kFlagInUse = 0x01;
constexpr std::uint8_t kFlagTransform = 0x02;

// In UTF-8, every byte of a character except the first is 10xxxxxx.
bool begins_character(char letter) { return (static_cast<unsigned char>(letter) & 0xC0U) != 0x80U; }

std::uint8_t flags_of(const MapState& state) {
  const unsigned in_use = state.in_use ? kFlagInUse : 0U;
  const unsigned transform = state.layer.transform ? kFlagTransform : 0U;
  return static_cast<std::uint8_t>(in_use | transform);
}

void write_layer(const map::LayerReport& layer, std::uint8_t flags, std::uint8_t source,
                 wire::ByteWriter& out) {
  out.u8(static_cast<std::uint8_t>(layer.cause));
  out.u8(layer.radius);
  out.u16_be(layer.tiles_drawn);
  out.u16_be(layer.tiles_outside);
  out.u16_be(layer.tiles_waiting);
  out.u8(flags);
  out.u8(source);
  out.u32_be(layer.crc);
  out.u64_be(layer.origin);
  pose::write(layer.transform, out);
}

void write_delivery(const map::DeliveryReport& delivery, wire::ByteWriter& out) {
  out.u8(static_cast<std::uint8_t>(delivery.state));
  out.u8(static_cast<std::uint8_t>(delivery.last_refusal));
  out.u8(map::kCauseCount);
  out.u8(map::kFateCount);
  out.u32_be(delivery.blocks_refused);
  out.u32_be(delivery.incoming.crc);
  out.u32_be(delivery.incoming.bytes);
  out.u32_be(delivery.chunks_there);
}

// Skips counts that a later version appends.
void read_counts(std::size_t count, std::span<std::uint32_t> counts, wire::ByteReader& in) {
  for (std::size_t i = 0; i < count; ++i) {
    const std::uint32_t value = in.u32_be();
    if (i < counts.size()) {
      counts[i] = value;
    }
  }
}

// Unknown causes, states and refusals of a later version keep their numeric values.
void read_fields(wire::ByteReader& in, MapState& state) {
  map::LayerReport& layer = state.layer;
  layer.cause = static_cast<map::Cause>(in.u8());
  layer.radius = in.u8();
  layer.tiles_drawn = in.u16_be();
  layer.tiles_outside = in.u16_be();
  layer.tiles_waiting = in.u16_be();
  const std::uint8_t flags = in.u8();
  const std::uint8_t source = in.u8();
  layer.crc = in.u32_be();
  layer.origin = in.u64_be();
  const pose::MapTransform transform = pose::read_map_transform(in);
  if ((flags & kFlagInUse) != 0) {
    state.in_use = MapInUse{.source = source};
  }
  if ((flags & kFlagTransform) != 0) {
    layer.transform = transform;
  }
}

}  // namespace

void MapInUse::set_words(std::string_view text) {
  std::size_t bytes = std::min(text.size(), attribution.size());
  while (bytes > 0 && bytes < text.size() && !begins_character(text[bytes])) {
    --bytes;
  }
  attribution = {};
  std::ranges::copy(text.substr(0, bytes), attribution.begin());
  attribution_bytes = static_cast<std::uint8_t>(bytes);
}

MapInUse in_use(const map::Block& block) {
  MapInUse in_use{.source = static_cast<std::uint8_t>(block.source())};
  in_use.set_words(block.attribution());
  return in_use;
}

std::size_t write_map_state(const MapState& state, std::span<std::byte> buffer) {
  const MapInUse in_use = state.in_use.value_or(MapInUse{});
  constexpr std::size_t kCounts = map::kCauseCount + map::kFateCount;
  wire::ByteWriter out(buffer);
  out.u16_be(static_cast<std::uint16_t>(kFixedBytes + 4 * kCounts + in_use.words().size()));
  write_layer(state.layer, flags_of(state), in_use.source, out);
  write_delivery(state.delivery, out);
  out.u8(in_use.attribution_bytes);
  out.zeros(3);
  for (const std::uint32_t times : state.layer.begun) {
    out.u32_be(times);
  }
  for (const std::uint32_t datagrams : state.delivery.fates) {
    out.u32_be(datagrams);
  }
  out.bytes(std::as_bytes(std::span(in_use.words())));
  return out.ok() ? out.written().size() : 0;
}

std::optional<MapState> read_map_state(std::span<const std::byte> bytes) {
  wire::ByteReader whole(bytes);
  const std::size_t length = whole.u16_be();
  if (length < kFixedBytes || length > bytes.size()) {
    return std::nullopt;
  }
  wire::ByteReader in(bytes.first(length).subspan(2));
  MapState state;
  read_fields(in, state);
  map::DeliveryReport& delivery = state.delivery;
  delivery.state = static_cast<map::DeliveryState>(in.u8());
  delivery.last_refusal = static_cast<map::Refusal>(in.u8());
  const std::size_t causes = in.u8();
  const std::size_t fates = in.u8();
  for (std::uint32_t* value : {&delivery.blocks_refused, &delivery.incoming.crc,
                               &delivery.incoming.bytes, &delivery.chunks_there}) {
    *value = in.u32_be();
  }
  const std::size_t attribution_bytes = in.u8();
  in.skip(3);
  read_counts(causes, state.layer.begun, in);
  read_counts(fates, delivery.fates, in);
  const std::span<const std::byte> words = in.bytes(attribution_bytes);
  if (state.in_use) {
    state.in_use->set_words({reinterpret_cast<const char*>(words.data()), words.size()});
  }
  return in.ok() ? std::optional(state) : std::nullopt;
}

}  // namespace iog::stream
