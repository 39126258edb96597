# Flags that every target of the project shares, and rooms as static libraries.

# Double rounding and contraction change bits: the host's twins of the shaders need plain IEEE arithmetic.
set(CROSSLIGHT_FLAGS -Wall -Wextra -Wpedantic -Wshadow -Wconversion -Wno-sign-conversion -ffp-contract=off)
if(CROSSLIGHT_WERROR)
  list(APPEND CROSSLIGHT_FLAGS -Werror)
endif()

function(crosslight_flags target)
  target_compile_options(${target} PRIVATE ${CROSSLIGHT_FLAGS})
  if(CROSSLIGHT_SANITIZE)
    target_compile_options(${target} PRIVATE -fsanitize=${CROSSLIGHT_SANITIZE} -fno-sanitize-recover=all -fno-omit-frame-pointer)
    target_link_options(${target} PRIVATE -fsanitize=${CROSSLIGHT_SANITIZE})
  endif()
endfunction()

# crosslight_precompile(TARGET header...): headers of large libraries, read once for all files of the target. Files
# include what they use all the same.
function(crosslight_precompile target)
  target_precompile_headers(${target} PRIVATE ${ARGN})
  target_compile_options(${target} PRIVATE $<$<CXX_COMPILER_ID:GNU>:-fpch-preprocess>)  # for ccache
endfunction()

# crosslight_room(NAME [USES room...] [LIBS library...] [PRECOMPILE header...]): all .cpp files of renderer/NAME as
# crosslight_NAME. A room that has only headers (yet) is an interface library.
function(crosslight_room name)
  cmake_parse_arguments(ROOM "" "" "USES;LIBS;PRECOMPILE" ${ARGN})
  file(GLOB sources CONFIGURE_DEPENDS ${CMAKE_SOURCE_DIR}/renderer/${name}/*.cpp)
  set(room crosslight_${name})
  set(scope PUBLIC)
  if(sources)
    add_library(${room} STATIC ${sources})
    crosslight_flags(${room})
    set_property(GLOBAL APPEND PROPERTY CROSSLIGHT_ROOMS ${room})
    if(ROOM_PRECOMPILE)
      crosslight_precompile(${room} ${ROOM_PRECOMPILE})
    endif()
  else()
    set(scope INTERFACE)
    add_library(${room} INTERFACE)
  endif()
  target_include_directories(${room} ${scope} ${CMAKE_SOURCE_DIR}/renderer ${CMAKE_SOURCE_DIR}/shaders/shared)
  foreach(used ${ROOM_USES})
    target_link_libraries(${room} ${scope} crosslight_${used})
  endforeach()
  target_link_libraries(${room} ${scope} glm::glm ${ROOM_LIBS})
endfunction()
