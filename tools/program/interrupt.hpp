// Ctrl-C and a plain kill end long work in good order: what has been done is still reported.
#pragma once

namespace iog::tools {

// From now on SIGINT and SIGTERM are only remembered, and interrupt waiting system calls. A reader
// of our output who has gone away does not end us either.
void catch_interrupts();

[[nodiscard]] bool was_interrupted();

}  // namespace iog::tools
