# The rooms as one shared library, and all that an installation has. Included after the rooms.
find_package(glm REQUIRED)
include(CMakePackageConfigHelpers)

get_property(rooms GLOBAL PROPERTY CROSSLIGHT_ROOMS)
set(symbols ${CMAKE_SOURCE_DIR}/ci/cmake/crosslight.map)
add_library(crosslight SHARED)
add_library(crosslight::crosslight ALIAS crosslight)
crosslight_flags(crosslight)
# All objects of all rooms; the archives are named too, for the foreign libraries that they bring.
foreach(room ${rooms})
  target_sources(crosslight PRIVATE $<TARGET_OBJECTS:${room}>)
endforeach()
target_link_libraries(crosslight PRIVATE ${rooms})
# Only the project's own names leave: bundled header libraries must not meet a host program's copies of them.
target_link_options(crosslight PRIVATE LINKER:--version-script=${symbols})
set_target_properties(crosslight PROPERTIES VERSION ${PROJECT_VERSION} SOVERSION ${PROJECT_VERSION_MAJOR}.${PROJECT_VERSION_MINOR}
                                            LINK_DEPENDS ${symbols})
target_compile_features(crosslight INTERFACE cxx_std_20)
target_include_directories(crosslight INTERFACE
  $<BUILD_INTERFACE:${CMAKE_SOURCE_DIR}/renderer> $<BUILD_INTERFACE:${CMAKE_SOURCE_DIR}/shaders/shared>
  $<INSTALL_INTERFACE:${CMAKE_INSTALL_INCLUDEDIR}> $<INSTALL_INTERFACE:${CMAKE_INSTALL_INCLUDEDIR}/crosslight>
  $<INSTALL_INTERFACE:${CMAKE_INSTALL_INCLUDEDIR}/crosslight/shared>)
target_link_libraries(crosslight INTERFACE glm::glm)

# Public headers: what renderer/app/crosslight.h reaches. tests/consumer would not compile without any of them.
set(public_headers
  app/render_job.h
  trace/ray_tree.h
  base/error.h base/interrupt.h base/log.h
  gpu/device.h
  image/image.h image/image_io.h
  scene/displacement.h scene/load.h scene/material_table.h scene/scene.h scene/settings.h scene/shape_mesh.h)
foreach(header ${public_headers})
  get_filename_component(room ${header} DIRECTORY)
  install(FILES ${CMAKE_SOURCE_DIR}/renderer/${header} DESTINATION ${CMAKE_INSTALL_INCLUDEDIR}/crosslight/${room})
endforeach()
install(FILES ${CMAKE_SOURCE_DIR}/renderer/app/crosslight.h DESTINATION ${CMAKE_INSTALL_INCLUDEDIR}/crosslight)
install(FILES ${CMAKE_SOURCE_DIR}/shaders/shared/lists.h ${CMAKE_SOURCE_DIR}/shaders/shared/types.h
        DESTINATION ${CMAKE_INSTALL_INCLUDEDIR}/crosslight/shared)

set(package_dir ${CMAKE_INSTALL_LIBDIR}/cmake/crosslight)
install(TARGETS crosslight EXPORT crosslightTargets LIBRARY DESTINATION ${CMAKE_INSTALL_LIBDIR})
install(EXPORT crosslightTargets NAMESPACE crosslight:: DESTINATION ${package_dir})
configure_package_config_file(${CMAKE_SOURCE_DIR}/ci/cmake/crosslightConfig.cmake.in
                              ${CMAKE_BINARY_DIR}/crosslightConfig.cmake INSTALL_DESTINATION ${package_dir})
# Before 1.0 a minor version may change the interface.
write_basic_package_version_file(${CMAKE_BINARY_DIR}/crosslightConfigVersion.cmake COMPATIBILITY SameMinorVersion)
install(FILES ${CMAKE_BINARY_DIR}/crosslightConfig.cmake ${CMAKE_BINARY_DIR}/crosslightConfigVersion.cmake
        DESTINATION ${package_dir})
file(RELATIVE_PATH CROSSLIGHT_PREFIX_FROM_PC /prefix/${CMAKE_INSTALL_LIBDIR}/pkgconfig /prefix)
configure_file(${CMAKE_SOURCE_DIR}/ci/cmake/crosslight.pc.in ${CMAKE_BINARY_DIR}/crosslight.pc @ONLY)
install(FILES ${CMAKE_BINARY_DIR}/crosslight.pc DESTINATION ${CMAKE_INSTALL_LIBDIR}/pkgconfig)
install(FILES ${CMAKE_SOURCE_DIR}/LICENSE ${CMAKE_SOURCE_DIR}/README.md DESTINATION ${CMAKE_INSTALL_DOCDIR})
