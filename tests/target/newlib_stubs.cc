// What GoogleTest wants from an operating system and newlib does not bring: nothing that a test uses.
#include <sys/stat.h>

#include <cerrno>

extern "C" int mkdir(const char* /*path*/, mode_t /*mode*/) {
  errno = ENOSYS;
  return -1;
}
