# The project's version and the checked-out commit as a C++ source. Written anew when the commit changes (git's own log of
# HEAD does), not at every build.
find_package(Git QUIET)
set(build_info ${CMAKE_CURRENT_BINARY_DIR}/build_info.cpp)
set(head_log)
if(Git_FOUND)
  execute_process(COMMAND ${GIT_EXECUTABLE} rev-parse --git-path logs/HEAD WORKING_DIRECTORY ${CMAKE_SOURCE_DIR}
                  OUTPUT_VARIABLE head_log OUTPUT_STRIP_TRAILING_WHITESPACE ERROR_QUIET)
  if(head_log)
    get_filename_component(head_log ${head_log} ABSOLUTE BASE_DIR ${CMAKE_SOURCE_DIR})
    if(NOT EXISTS ${head_log})
      set(head_log)
    endif()
  endif()
endif()
add_custom_command(
  OUTPUT ${build_info}
  COMMAND ${CMAKE_COMMAND} -DOUTPUT=${build_info} -DSOURCE_DIR=${CMAKE_SOURCE_DIR} -DVERSION=${PROJECT_VERSION}
          "-DGIT=${GIT_EXECUTABLE}" -P ${CMAKE_SOURCE_DIR}/ci/cmake/WriteBuildInfo.cmake
  DEPENDS ${head_log} ${CMAKE_SOURCE_DIR}/ci/cmake/WriteBuildInfo.cmake
  COMMENT "Version and commit"
  VERBATIM)
add_library(crosslight_build_info STATIC ${build_info})
crosslight_flags(crosslight_build_info)
target_include_directories(crosslight_build_info PRIVATE ${CMAKE_SOURCE_DIR}/renderer)
target_link_libraries(crosslight_app PUBLIC crosslight_build_info)
set_property(GLOBAL APPEND PROPERTY CROSSLIGHT_ROOMS crosslight_build_info)
