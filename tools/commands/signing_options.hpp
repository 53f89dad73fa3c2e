// Options of commands that send poses or maps to a target that wants them signed, and of those that
// read its stream.
#pragma once

#include <CLI/CLI.hpp>
#include <cstdint>
#include <string>

#include "tools/replay/command_signer.hpp"

namespace iog::tools {

struct SigningOptions {
  std::string key;
  std::string freshness;
  std::uint16_t listen = 0;
  std::string bind = "127.0.0.1";
};

// --key and --freshness.
void add_signing_options(CLI::App& command, SigningOptions& options);
// And --listen and --bind, where a command has them for nothing else.
void add_listening_options(CLI::App& command, SigningOptions& options);

// --key of a receiver: it believes what is signed with the key of that file, and nothing else.
void add_believing_option(CLI::App& command, std::string& key);

// Hears the target for up to 5 s if it is told where. UsageError, or CheckFailed if the target says
// nothing, or wants nothing signed. Without a key it signs nothing.
[[nodiscard]] CommandSigner signer_of(const SigningOptions& options);

}  // namespace iog::tools
