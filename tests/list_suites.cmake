# Asks an executable of GoogleTest for its suites, and writes for ctest one test for each,
# `<room>/<Suite>`. It is run when the executable has been built:
#
#   cmake -D EXECUTABLE=<path> [-D RUNNER=<path>] -D ROOM=<room> -D LABEL=<label> [-D LONG=<suites>]
#     [-D SLOW=<suites>] -D OUTPUT=<file> -P list_suites.cmake
#
# RUNNER: what starts the executable where this machine cannot. LABEL: one or more. LONG: suites whose label is
# the first one with _all behind it. SLOW: suites that have only the first one.
cmake_policy(SET CMP0057 NEW)  # IN_LIST
execute_process(COMMAND ${RUNNER} ${EXECUTABLE} --gtest_list_tests
  TIMEOUT 60 OUTPUT_VARIABLE listed RESULT_VARIABLE status)
if(NOT status EQUAL 0)
  message(FATAL_ERROR "${EXECUTABLE} does not list its tests (${status}):\n${listed}")
endif()

# A suite begins its line, as `Suite.` or `Suite/0.  # TypeParam = int`; its cases are indented.
string(REGEX MATCHALL "(^|\n)[A-Za-z0-9_/]+\\." suites "${listed}")
if(NOT suites)
  message(FATAL_ERROR "${EXECUTABLE} has no tests:\n${listed}")
endif()

# Large grids come from the heap again and again; without this each of them is asked of the kernel
# anew, page by page, which takes a third of the time. AddressSanitizer has a heap of its own.
set(environment "")
if(NOT RUNNER)
  string(JOIN ":" tunables "GLIBC_TUNABLES=glibc.malloc.mmap_max=0"
    "glibc.malloc.trim_threshold=17179869184" "glibc.malloc.top_pad=16777216")
  set(environment " ENVIRONMENT ${tunables}")
endif()

list(TRANSFORM suites REPLACE "[\n.]" "")
foreach(suite IN LISTS LONG SLOW)
  if(NOT suite IN_LIST suites)
    message(FATAL_ERROR "${EXECUTABLE} has no suite ${suite} that could be long:\n${listed}")
  endif()
endforeach()
set(script "")
foreach(suite IN LISTS suites)
  set(label "${LABEL}")
  if(suite IN_LIST LONG)
    list(GET LABEL 0 label)
    string(APPEND label _all)
  elseif(suite IN_LIST SLOW)
    list(GET LABEL 0 label)
  endif()
  string(APPEND script
    "add_test([[${ROOM}/${suite}]] ${RUNNER} [[${EXECUTABLE}]] [[--gtest_filter=${suite}.*]])\n"
    "set_tests_properties([[${ROOM}/${suite}]] PROPERTIES LABELS [[${label}]] TIMEOUT 600${environment})\n")
endforeach()
file(WRITE ${OUTPUT} "${script}")
