# Cross toolchain for the Cortex-A53 of the Zynq UltraScale+.
#
# As in arm-none-eabi-cortex-a9.cmake only what every object file must agree on stands here. Debian has no bare
# compiler for AArch64; its Linux compiler makes the same objects. The firmware links none of its libraries, and the
# tests link all of them, statically, and run in qemu-aarch64.
set(CMAKE_SYSTEM_NAME Generic)
set(CMAKE_SYSTEM_PROCESSOR aarch64)
set(IOG_BOARD zcu102)

set(CMAKE_C_COMPILER aarch64-linux-gnu-gcc)
set(CMAKE_CXX_COMPILER aarch64-linux-gnu-g++)
set(CMAKE_ASM_COMPILER aarch64-linux-gnu-gcc)
set(CMAKE_OBJCOPY aarch64-linux-gnu-objcopy)
set(CMAKE_OBJDUMP aarch64-linux-gnu-objdump)
set(CMAKE_NM aarch64-linux-gnu-nm)
set(CMAKE_SIZE aarch64-linux-gnu-size)

# This core has no atomic instructions of its own, and calls for them need a library. The two fixes avoid errata of
# the Cortex-A53: 835769 by the compiler, 843419 by the linker. Code is where it is linked, without a stack protector.
set(iog_cortex_a53
  "-mcpu=cortex-a53 -mno-outline-atomics -mfix-cortex-a53-835769 -mfix-cortex-a53-843419 -fno-pic -fno-stack-protector")

# As for the Cortex-A9: an image is the same wherever it was built.
get_filename_component(iog_root "${CMAKE_CURRENT_LIST_DIR}" DIRECTORY)
cmake_path(RELATIVE_PATH iog_root BASE_DIRECTORY "${CMAKE_BINARY_DIR}"
  OUTPUT_VARIABLE iog_way_to_root)
string(APPEND iog_cortex_a53
  " -ffile-prefix-map=${iog_root}/= -ffile-prefix-map=${iog_way_to_root}/=")

set(CMAKE_C_FLAGS_INIT "${iog_cortex_a53} -ffunction-sections -fdata-sections")
set(CMAKE_CXX_FLAGS_INIT "${iog_cortex_a53} -ffunction-sections -fdata-sections")
set(CMAKE_ASM_FLAGS_INIT "${iog_cortex_a53}")
set(CMAKE_EXE_LINKER_FLAGS_INIT "-static -no-pie")

set(CMAKE_TRY_COMPILE_TARGET_TYPE STATIC_LIBRARY)

set(CMAKE_FIND_ROOT_PATH_MODE_PROGRAM NEVER)
set(CMAKE_FIND_ROOT_PATH_MODE_LIBRARY ONLY)
set(CMAKE_FIND_ROOT_PATH_MODE_INCLUDE ONLY)
