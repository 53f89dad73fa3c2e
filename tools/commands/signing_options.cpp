#include "tools/commands/signing_options.hpp"

#include <charconv>
#include <chrono>
#include <optional>

#include "tools/frames/frame_assembler.hpp"
#include "tools/program/add_option.hpp"
#include "tools/program/exit_status.hpp"
#include "tools/program/interrupt.hpp"
#include "tools/receive/udp_receiver.hpp"
#include "tools/report/counters.hpp"
#include "tools/vehicles/key_file.hpp"

namespace iog::tools {
namespace {

using authentication::Freshness;

std::uint32_t number_in(std::string_view text, int base) {
  std::uint32_t number = 0;
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), number, base);
  if (error != std::errc() || end != text.data() + text.size()) {
    throw UsageError(
        "--freshness is RUN:LAST, such as 1a2b3c4d:120, as `iog receive` shows it of the target");
  }
  return number;
}

Freshness freshness_in(std::string_view text) {
  const std::size_t colon = std::min(text.find(':'), text.size());
  return {.run = number_in(text.substr(0, colon), 16),
          .counter = number_in(text.substr(std::min(colon + 1, text.size())), 10)};
}

// What the next whole frame says.
Freshness heard_freshness(const authentication::Key& key, const std::string& address,
                          std::uint16_t port) {
  constexpr std::chrono::seconds kPatience{5};
  std::optional<CommandCounts> counts;
  std::uint32_t run = 0;
  bool has_heard = false;
  UdpReceiver receiver(address, port);
  FrameAssembler assembler([&](GridFrame&& frame) {
    if (frame.has_end) {
      has_heard = true;
      counts = stream::counts_of<CommandCounts>(frame.end);
      run = frame.header.run_number;
    }
  });
  const auto end = std::chrono::steady_clock::now() + kPatience;
  while (!has_heard && !was_interrupted() && std::chrono::steady_clock::now() < end) {
    for (const UdpReceiver::Message& message : receiver.take(std::chrono::milliseconds(50))) {
      assembler.take(message.bytes);
    }
  }
  if (!has_heard) {
    throw CheckFailed("the target says nothing on port " + std::to_string(port) +
                      " of which run it is; does it run?");
  }
  if (!counts) {
    throw CheckFailed("the target does not want anything signed: its image has no key");
  }
  if (!is_signed_with(key, *counts, run)) {
    throw CheckFailed("what says on port " + std::to_string(port) +
                      " which run it is does not have this key; is it the target, and the key of "
                      "its image?");
  }
  return freshness_of(*counts, run);
}

}  // namespace

void add_signing_options(CLI::App& command, SigningOptions& options) {
  add_option(command, "--key", "FILE", options.key,
             "Sign with the key of this file, for a car with `authentication`");
  add_option(command, "--freshness", "RUN:LAST", options.freshness,
             "Run and last counter of the target, as `iog receive` shows them")
      ->needs("--key");
}

void add_listening_options(CLI::App& command, SigningOptions& options) {
  add_option(command, "--listen", "PORT", options.listen,
             "UDP port of the target's stream, which states both, instead of --freshness")
      ->needs("--key")
      ->excludes("--freshness")
      ->check(CLI::Range(1, 65'535));
  add_option(command, "--bind", "ADDRESS  (default 127.0.0.1)", options.bind,
             "IPv4 address to listen on")
      ->needs("--listen");
}

void add_believing_option(CLI::App& command, std::string& key) {
  add_option(command, "--key", "FILE", key,
             "Accept only messages that are signed with the key of this file");
}

CommandSigner signer_of(const SigningOptions& options) {
  if (options.key.empty()) {
    return {};
  }
  const authentication::Key key = read_key_file(options.key);
  if (!options.freshness.empty()) {
    return {key, freshness_in(options.freshness)};
  }
  if (options.listen == 0) {
    throw UsageError(
        "--key: give --listen PORT or --freshness RUN:LAST, too: what is signed is "
        "signed for one run of the target");
  }
  return {key, heard_freshness(key, options.bind, options.listen)};
}

}  // namespace iog::tools
