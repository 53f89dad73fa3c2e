# The one list of warnings. Every target of this project, on every compiler, is built with it.
add_library(iog_warnings INTERFACE)
target_compile_options(iog_warnings INTERFACE
  -Wall -Wextra -Wpedantic -Werror
  -Wconversion -Wsign-conversion -Wshadow -Wcast-align -Wcast-qual
  -Wold-style-cast -Wnon-virtual-dtor -Woverloaded-virtual -Wnull-dereference
  -Wdouble-promotion -Wformat=2 -Wundef -Wvla -Wimplicit-fallthrough
  -Wmissing-declarations
  $<$<CXX_COMPILER_ID:GNU>:-Wduplicated-cond;-Wduplicated-branches;-Wlogical-op;-Wuseless-cast>)
