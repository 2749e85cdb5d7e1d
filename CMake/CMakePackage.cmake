# The CMake package of the installed modules: find_package(ScatteredIsopoints), then link
# ScatteredIsopoints::vtkScatteredIsopointFilters and ...Rendering.
include(CMakePackageConfigHelpers)

set(package_destination "${CMAKE_INSTALL_LIBDIR}/cmake/ScatteredIsopoints")
if (SCATTEREDISOPOINTS_USE_PARAVIEW)
  set(vtk_package "ParaView ${ParaView_VERSION} EXACT")
else ()
  set(vtk_package "VTK ${VTK_VERSION} EXACT COMPONENTS ${vtk_components}")
  string(REPLACE ";" " " vtk_package "${vtk_package}")
endif ()
configure_package_config_file("CMake/ScatteredIsopointsConfig.cmake.in"
  "${CMAKE_BINARY_DIR}/${package_destination}/ScatteredIsopointsConfig.cmake"
  INSTALL_DESTINATION "${package_destination}"
  NO_SET_AND_CHECK_MACRO)
write_basic_package_version_file(
  "${CMAKE_BINARY_DIR}/${package_destination}/ScatteredIsopointsConfigVersion.cmake"
  COMPATIBILITY SameMajorVersion)
install(FILES
  "${CMAKE_BINARY_DIR}/${package_destination}/ScatteredIsopointsConfig.cmake"
  "${CMAKE_BINARY_DIR}/${package_destination}/ScatteredIsopointsConfigVersion.cmake"
  DESTINATION "${package_destination}"
  COMPONENT development)
