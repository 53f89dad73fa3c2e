// Which commands a user may run next on the drive of a command.
#pragma once

#include <string>

namespace CLI {
class App;
}

namespace iog::tools {

// Rows of `iog fuse`'s table: to look at the same captures, poses and car, or to record them. A
// shell takes the commands as they are. Empty if a script reads the output, which no terminal
// shows.
[[nodiscard]] std::string rows_of_next_steps(const CLI::App& command);

}  // namespace iog::tools
