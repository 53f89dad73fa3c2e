#include "preload.hpp"

#include <cstring>
#include <dlfcn.h>

namespace iog::a9_model {
namespace {

// GLib's GByteArray.
struct Bytes {
  const std::uint8_t* data;
  unsigned length;
};

// None of them is part of the plugin interface.
struct Functions {
  void* (*processor)(int index) = nullptr;
  Bytes* (*new_bytes)() = nullptr;
  Bytes* (*set_length)(Bytes* bytes, unsigned length) = nullptr;
  int (*read)(void* processor, Bytes* bytes, int number) = nullptr;
};

template <typename Function>
void find(Function& function, const char* name) {
  function = reinterpret_cast<Function>(dlsym(RTLD_DEFAULT, name));
}

const Functions& functions() {
  static const Functions found = [] {
    Functions result;
    find(result.processor, "qemu_get_cpu");
    find(result.new_bytes, "g_byte_array_new");
    find(result.set_length, "g_byte_array_set_size");
    find(result.read, "arm_cpu_gdb_read_register");
    return result;
  }();
  return found;
}

}  // namespace

bool can_read_registers() {
  const Functions& found = functions();
  return found.processor != nullptr && found.new_bytes != nullptr && found.set_length != nullptr &&
         found.read != nullptr;
}

std::uint32_t register_of_processor(std::uint32_t number) {
  static Bytes* const bytes = functions().new_bytes();
  functions().set_length(bytes, 0);
  functions().read(functions().processor(0), bytes, static_cast<int>(number));
  std::uint32_t value = 0;
  std::memcpy(&value, bytes->data, sizeof value);
  return value;
}

}  // namespace iog::a9_model
