#include "stream/car_refusal.hpp"

#include "wire/byte_reader.hpp"
#include "wire/byte_writer.hpp"

namespace iog::stream {

std::size_t write_car_refusal(const CarRefusal& refusal, std::span<std::byte> buffer) {
  const std::string_view words = refusal.words.substr(0, kMaxRefusalWords);
  wire::ByteWriter out(buffer);
  out.u8(refusal.reason);
  out.u8(static_cast<std::uint8_t>(words.size()));
  out.zeros(2);
  out.bytes(std::as_bytes(std::span(words)));
  return out.ok() ? out.written().size() : 0;
}

std::optional<CarRefusal> read_car_refusal(std::span<const std::byte> body) {
  wire::ByteReader in(body);
  CarRefusal refusal;
  refusal.reason = in.u8();
  const std::size_t length = in.u8();
  in.skip(2);
  const std::span<const std::byte> words = in.bytes(length);
  refusal.words = {reinterpret_cast<const char*>(words.data()), words.size()};
  return in.ok() ? std::optional(refusal) : std::nullopt;
}

}  // namespace iog::stream
