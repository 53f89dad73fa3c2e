# What every board's library has: included first by the folder of the board.
include(${PROJECT_SOURCE_DIR}/toolchain/freestanding.cmake)

set(IOG_COMMON_BOARD ${PROJECT_SOURCE_DIR}/board/common)
set(IOG_CORES 4 CACHE STRING "cores that work in the firmware images (1 to 4)")
configure_file(${IOG_COMMON_BOARD}/core_count.hpp.in ${CMAKE_CURRENT_BINARY_DIR}/core_count.hpp @ONLY)
configure_file(${IOG_COMMON_BOARD}/version.hpp.in ${CMAKE_CURRENT_BINARY_DIR}/version.hpp @ONLY)

set(IOG_COMMON_BOARD_SOURCES board_run.cpp boot_record.cpp constant_memory.cpp ending.cpp helper.cpp memory_functions_neon.cpp
  stack_gauge.cpp text_line.cpp)
list(TRANSFORM IOG_COMMON_BOARD_SOURCES PREPEND ${IOG_COMMON_BOARD}/)
set_source_files_properties(${IOG_COMMON_BOARD}/memory_functions_neon.cpp PROPERTIES
  COMPILE_OPTIONS "-O3;-fno-tree-loop-distribute-patterns")
