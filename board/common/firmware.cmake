# The firmware images, from what the board's folder and linker/ hold: included last by the folder of the board.

# A firmware image, <name>.elf with <name>.map beside it, for QEMU and the board alike.
#
#   iog_add_firmware(<name> <source>...)     further libraries by target_link_libraries(<name> ...)
#
# Linked with nothing but libgcc, then sealed: the CRC of code and constants is in the image (seal_image). The build
# fails if the image holds a heap, exceptions, RTTI, a piece of a C library, floating-point arithmetic (check_image) or,
# on the i.MX6, an instruction that an erratum of the processor needs (check_errata).
function(iog_add_firmware name)
  set(layout ${PROJECT_SOURCE_DIR}/linker/${IOG_BOARD}.ld)
  set(included ${PROJECT_SOURCE_DIR}/linker/image.ld ${PROJECT_SOURCE_DIR}/linker/debug.ld)
  set(peripherals ${PROJECT_SOURCE_DIR}/linker/${IOG_BOARD}_peripherals.ld)
  add_executable(${name} ${ARGN} ${CMAKE_CURRENT_FUNCTION_LIST_DIR}/../${IOG_BOARD}/startup.S)
  set_target_properties(${name} PROPERTIES
    SUFFIX .elf
    LINK_DEPENDS "${layout};${included};${peripherals};${CMAKE_CURRENT_FUNCTION_LIST_DIR}/seal_image")
  target_link_libraries(${name} PRIVATE iog_board_${IOG_BOARD} iog_warnings)
  target_link_options(${name} PRIVATE
    -L${PROJECT_SOURCE_DIR}/linker "SHELL:-T ${layout}" "SHELL:-T ${peripherals}"
    -Wl,--gc-sections -Wl,--fatal-warnings -Wl,--build-id=none
    -Wl,-Map=$<TARGET_FILE_DIR:${name}>/${name}.map)
  add_custom_command(TARGET ${name} POST_BUILD
    COMMAND ${CMAKE_CURRENT_FUNCTION_LIST_DIR}/seal_image ${CMAKE_NM} $<TARGET_FILE:${name}>
    COMMAND ${CMAKE_CURRENT_FUNCTION_LIST_DIR}/../${IOG_BOARD}/check_image
      ${CMAKE_NM} ${CMAKE_OBJDUMP} ${CMAKE_SIZE} $<TARGET_FILE:${name}>
    VERBATIM)
endfunction()

# A block made by `iog map`, which the images carry and use until another one is delivered.
set(IOG_MAP "" CACHE FILEPATH "Map in the firmware images (town.iogmap); none if empty")
set(baked_map ${CMAKE_CURRENT_BINARY_DIR}/baked_map.S)
set(IOG_INCLUDE_MAP "")
if(IOG_MAP)
  get_filename_component(map ${IOG_MAP} ABSOLUTE BASE_DIR ${PROJECT_SOURCE_DIR})
  file(SIZE ${map} map_bytes)
  if(map_bytes GREATER 4194304)
    message(FATAL_ERROR "IOG_MAP: ${map} is longer than 4 MiB")
  endif()
  set(IOG_INCLUDE_MAP ".incbin \"${map}\"")
  set_source_files_properties(${baked_map} PROPERTIES OBJECT_DEPENDS ${map})
endif()
configure_file(${IOG_COMMON_BOARD}/baked_map.S.in ${baked_map} @ONLY)

# The firmware for cars that ask for these grids. Which car it is, the block of an image says.
foreach(grids IN ITEMS Indexes Classes Both)
  string(TOLOWER ${grids} kind)
  configure_file(${IOG_COMMON_BOARD}/firmware_grids.hpp.in ${CMAKE_CURRENT_BINARY_DIR}/${kind}/firmware_grids.hpp @ONLY)
  add_library(iog_firmware_${kind} OBJECT ${IOG_COMMON_BOARD}/main.cpp)
  target_include_directories(iog_firmware_${kind} PRIVATE ${CMAKE_CURRENT_BINARY_DIR}/${kind})
  target_link_libraries(iog_firmware_${kind}
    PUBLIC iog_board_${IOG_BOARD} iog_app iog_car_block PRIVATE iog_warnings)
endforeach()

# iog_add_images(<name> <grids> <block of its car> <what makes the block>): iogrid-<name>.elf. Target
# images-<name> makes of it what the loaders of the board start, in images/<name>/; it needs what
# `toolchain/install boot` installs.
function(iog_add_images name grids car_block block_maker)
  set(source ${CMAKE_CURRENT_BINARY_DIR}/car_block-${name}.S)
  configure_file(${IOG_COMMON_BOARD}/car_block.S.in ${source} @ONLY)
  set_source_files_properties(${source} PROPERTIES OBJECT_DEPENDS ${car_block})
  iog_add_firmware(iogrid-${name} ${baked_map} ${source})
  target_link_libraries(iogrid-${name} PRIVATE iog_firmware_${grids})
  add_dependencies(iogrid-${name} ${block_maker})
  if(NOT EXISTS ${CMAKE_CURRENT_SOURCE_DIR}/images/make_images)
    return()
  endif()
  set(images ${CMAKE_CURRENT_BINARY_DIR}/images/${name})
  set(maker ${CMAKE_CURRENT_SOURCE_DIR}/images/make_images)
  add_custom_command(OUTPUT ${images}/iogrid.img
    COMMAND ${maker} ${CMAKE_OBJCOPY} ${CMAKE_NM} $<TARGET_FILE:iogrid-${name}> ${images}
    DEPENDS iogrid-${name} ${maker} images/bootscript
    COMMENT "Images of iogrid-${name} for the board's loaders"
    VERBATIM)
  add_custom_target(images-${name} DEPENDS ${images}/iogrid.img)
endfunction()

# One for each car of vehicles/.
foreach(car IN LISTS IOG_CARS)
  iog_add_images(${car} ${IOG_GRIDS_OF_${car}} ${IOG_CAR_BLOCKS}/${car}.block iog_vehicles)
endforeach()

# And one of each kind without a car, for cars of one's own: `iog image` puts them there.
foreach(grids IN ITEMS indexes classes both)
  set(block ${CMAKE_CURRENT_BINARY_DIR}/${grids}/no_car.block)
  add_custom_command(OUTPUT ${block}
    COMMAND ${IOG_MAKE_CAR_BLOCK} --grids ${grids} ${block}
    DEPENDS ${IOG_MAKE_CAR_BLOCK} make_car_block
    VERBATIM)
  add_custom_target(no_car-${grids} DEPENDS ${block})
  iog_add_images(${grids} ${grids} ${block} no_car-${grids})
endforeach()
