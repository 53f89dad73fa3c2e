// What a broken requirement of the core (src/require/) does in a test: it says where, and fails.
#include <cstdio>
#include <cstdlib>

#include "require/require.hpp"

namespace iog {

void programmer_error(const char* file, int line) {
  std::printf("%s:%d: a requirement does not hold\n", file, line);
  std::fflush(stdout);
  std::abort();
}

}  // namespace iog
