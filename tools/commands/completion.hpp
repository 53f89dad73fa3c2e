// What the shell may offer for the last word of an unfinished command line, by the commands and
// options themselves.
#pragma once

#include <string>
#include <vector>

namespace CLI {
class App;
}

namespace iog::tools {

// The first argument of a shell that asks: `iog __complete fuse --pcap dri`.
inline constexpr const char* kCompleteWord = "__complete";

// One candidate per line; the shell keeps those that begin with the last word. `*` stands for
// files, `*.pcap` for files of this ending, `*/` for folders.
//
// The help of an option tells its values: {a,b} of a validator, FILE and FOLDER in its text, and
// endings such as
// (.pcap, .gz), FILE.mcap or CAR.toml.
void print_completions(const CLI::App& program, std::vector<std::string> words);

}  // namespace iog::tools
