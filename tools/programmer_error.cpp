// What a broken requirement of the core (src/require/) does on a PC: it says where, and stops.
#include <cstdio>
#include <cstdlib>

#include "require/require.hpp"

namespace iog {

void programmer_error(const char* file, int line) {
  std::fprintf(stderr, "%s:%d: a requirement does not hold; this is a fault of iog\n", file, line);
  std::abort();
}

}  // namespace iog
