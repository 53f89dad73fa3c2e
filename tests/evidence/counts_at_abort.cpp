// Linked into the tests by tests/coverage_campaign: what a test that has to die has run counts,
// too. Else gcov's counts are written only where a process ends by itself.
#include <csignal>

extern "C" void __gcov_dump();

namespace {

[[gnu::constructor]] void listen() {
  std::signal(SIGABRT, [](int /*signal*/) { __gcov_dump(); });
}

}  // namespace
