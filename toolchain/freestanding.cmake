# iog_freestanding: how code is compiled that runs with nothing beneath it.
#
# There is no C library, no heap, no unwinder and no static constructor in a firmware image.
# Asynchronous unwind tables would only cost space; a null pointer is a fault entry of the MMU, so
# the compiler may not reason that what was dereferenced cannot have been null.
add_library(iog_freestanding INTERFACE)
target_compile_options(iog_freestanding INTERFACE
  -ffreestanding
  -fno-delete-null-pointer-checks
  -fno-unwind-tables
  -fno-asynchronous-unwind-tables
  $<$<COMPILE_LANGUAGE:CXX>:-fno-exceptions>
  $<$<COMPILE_LANGUAGE:CXX>:-fno-rtti>
  $<$<COMPILE_LANGUAGE:CXX>:-fno-threadsafe-statics>
  $<$<COMPILE_LANGUAGE:CXX>:-fno-use-cxa-atexit>)
target_link_options(iog_freestanding INTERFACE -nostdlib)
