// What GoogleTest wants from an operating system and newlib does not bring; no test uses it.
#include <cerrno>
#include <sys/stat.h>

extern "C" int mkdir(const char* /*path*/, mode_t /*mode*/) {
  errno = ENOSYS;
  return -1;
}
