# Several sources as one for the compiler, most of whose time goes into what they include.
#
# CMake's own UNITY_BUILD writes absolute paths, so that ccache takes the sources of another clone, or of
# another work tree, for others. These are the same in each.

# iog_join(<target> <name> <source>...): these sources of the target are one, Unity/unity_<name>.cpp.
function(iog_join target name)
  set(folder ${CMAKE_CURRENT_BINARY_DIR}/Unity)
  set(includes "")
  foreach(source IN LISTS ARGN)
    get_filename_component(path ${source} ABSOLUTE)
    file(RELATIVE_PATH path ${folder} ${path})
    string(APPEND includes "#include \"${path}\"\n")
  endforeach()
  file(CONFIGURE OUTPUT ${folder}/unity_${name}.cpp CONTENT "${includes}" @ONLY)
  set_source_files_properties(${ARGN} PROPERTIES HEADER_FILE_ONLY ON)
  target_sources(${target} PRIVATE ${folder}/unity_${name}.cpp)
endfunction()

# iog_join_sources(<target> [<n>]): every n of the target's C++ sources are one, or all of them, but for
# those with the property IOG_ALONE, which have a name in common with another.
function(iog_join_sources target)
  get_target_property(sources ${target} SOURCES)
  set(joined "")
  foreach(source IN LISTS sources)
    get_source_file_property(is_alone ${source} IOG_ALONE)
    if(source MATCHES "[.]cpp$" AND NOT is_alone)
      list(APPEND joined ${source})
    endif()
  endforeach()
  list(LENGTH joined left)
  set(most ${left} ${ARGN})
  list(GET most -1 most)
  set(number 0)
  while(left GREATER 0)
    list(SUBLIST joined 0 ${most} batch)
    list(REMOVE_ITEM joined ${batch})
    iog_join(${target} ${target}_${number} ${batch})
    list(LENGTH joined left)
    math(EXPR number "${number} + 1")
  endwhile()
endfunction()
