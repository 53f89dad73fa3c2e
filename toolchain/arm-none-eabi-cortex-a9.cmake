# Cross toolchain for the Cortex-A9 of the i.MX6Q.
#
# Only what every object file must agree on stands here: the instruction set and the calling
# convention. The same objects serve the firmware, which has no C library, and the test images,
# which have newlib; what only the firmware may use is in freestanding.cmake.
set(CMAKE_SYSTEM_NAME Generic)
set(CMAKE_SYSTEM_PROCESSOR arm)
set(IOG_BOARD imx6)

set(CMAKE_C_COMPILER arm-none-eabi-gcc)
set(CMAKE_CXX_COMPILER arm-none-eabi-g++)
set(CMAKE_ASM_COMPILER arm-none-eabi-gcc)
set(CMAKE_OBJCOPY arm-none-eabi-objcopy)
set(CMAKE_OBJDUMP arm-none-eabi-objdump)
set(CMAKE_NM arm-none-eabi-nm)
set(CMAKE_SIZE arm-none-eabi-size)

# ARM state: the inner loops are short and the 1 MiB L2 holds all code. Hard-float calling
# convention: the core computes in integers, but NEON registers are where its vectors live.
set(iog_cortex_a9 "-mcpu=cortex-a9 -mfpu=neon -mfloat-abi=hard -marm")

# The place of a broken requirement is relative to the root of the project, as are all names of files, so
# that an image is the same wherever it was built. ccache hands the compiler paths relative to the build folder.
get_filename_component(iog_root "${CMAKE_CURRENT_LIST_DIR}" DIRECTORY)
cmake_path(RELATIVE_PATH iog_root BASE_DIRECTORY "${CMAKE_BINARY_DIR}"
  OUTPUT_VARIABLE iog_way_to_root)
string(APPEND iog_cortex_a9
  " -ffile-prefix-map=${iog_root}/= -ffile-prefix-map=${iog_way_to_root}/=")

# Pairs that could issue together wait for the same register less often (docs/figures.md: 1 % of a frame).
set(CMAKE_CXX_FLAGS_RELEASE_INIT "-frename-registers")

set(CMAKE_C_FLAGS_INIT "${iog_cortex_a9} -ffunction-sections -fdata-sections")
set(CMAKE_CXX_FLAGS_INIT "${iog_cortex_a9} -ffunction-sections -fdata-sections")
set(CMAKE_ASM_FLAGS_INIT "${iog_cortex_a9}")

# Nothing can be linked without choosing a board or newlib first, so CMake's probes stop at
# archives.
set(CMAKE_TRY_COMPILE_TARGET_TYPE STATIC_LIBRARY)

set(CMAKE_FIND_ROOT_PATH_MODE_PROGRAM NEVER)
set(CMAKE_FIND_ROOT_PATH_MODE_LIBRARY ONLY)
set(CMAKE_FIND_ROOT_PATH_MODE_INCLUDE ONLY)
