# Compiles through ccache where it is installed, so that what has been compiled once is not compiled
# again: not after `git clean`, not in another clone. IOG_CCACHE=OFF for a compiler without it.
option(IOG_CCACHE "Compile through ccache if it is there" ON)
find_program(IOG_CCACHE_PROGRAM ccache)
if(IOG_CCACHE AND IOG_CCACHE_PROGRAM AND NOT CMAKE_CXX_COMPILER_LAUNCHER)
  # Paths below the clone become relative before they are compared; precompiled headers are told by
  # what is in them, not by their time; the compiler's own list of headers is believed, so that a
  # source that was never compiled is not read twice; and what a file held is remembered by its inode,
  # or each compilation would read a precompiled header's tens of megabytes for its name alone.
  set(CMAKE_CXX_COMPILER_LAUNCHER
    env CCACHE_BASEDIR=${PROJECT_SOURCE_DIR} CCACHE_NOHASHDIR=1 CCACHE_DEPEND=1
    CCACHE_INODECACHE=1 CCACHE_SLOPPINESS=pch_defines,time_macros)
  if(CMAKE_CXX_COMPILER_ID STREQUAL Clang)
    list(APPEND CMAKE_CXX_COMPILER_LAUNCHER
      CCACHE_PCH_EXTSUM=1 ${CMAKE_CURRENT_LIST_DIR}/cached_clang)
  endif()
  list(APPEND CMAKE_CXX_COMPILER_LAUNCHER ${IOG_CCACHE_PROGRAM})
endif()
