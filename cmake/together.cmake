# together(TARGET [ROOMS]): with CMAKE_UNITY_BUILD, which the preset for users switches on, the files of a folder are compiled several
# at a time, for most of the time of one goes into headers. So the names in anonymous namespaces are distinct within a folder of
# sources; the tests of a file stand in a namespace of its name where they share names. Files with options of their own are
# compiled by themselves. ROOMS, if true: the files of all its folders count as those of one, in their order.
function(together TARGET)
  set(filesAtATime 16)
  get_target_property(sources ${TARGET} SOURCES)
  list(FILTER sources EXCLUDE REGEX "^\\$")  # objects of other targets
  set_target_properties(${TARGET} PROPERTIES UNITY_BUILD_MODE GROUP)
  if(CMAKE_UNITY_BUILD)
    set_target_properties(${TARGET} PROPERTIES DISABLE_PRECOMPILE_HEADERS ON)  # they save less than they take
  endif()
  foreach(source IN LISTS sources)
    file(RELATIVE_PATH folder ${PROJECT_SOURCE_DIR} ${source})
    get_filename_component(folder ${folder} DIRECTORY)
    if(ARGN)
      string(REGEX REPLACE "/[^/]*$" "" folder "${folder}")
    endif()
    string(MAKE_C_IDENTIFIER "${folder}" folder)
    if(NOT DEFINED count_${folder})
      set(count_${folder} 0)
    endif()
    math(EXPR batch "${count_${folder}} / ${filesAtATime}")
    math(EXPR count_${folder} "${count_${folder}} + 1")
    set_source_files_properties(${source} PROPERTIES UNITY_GROUP ${folder}_${batch})
  endforeach()
endfunction()
