# Everything that needs VTK or ParaView, except the Python package: modules and plugin.

set(python_modules
  ScatteredIsopoints::vtkScatteredIsopointFilters
  ScatteredIsopoints::vtkScatteredIsopointRendering)
set(module_files
  "${CMAKE_CURRENT_SOURCE_DIR}/Filters/vtk.module"
  "${CMAKE_CURRENT_SOURCE_DIR}/Rendering/vtk.module")
set(plugin_modules ${python_modules})
if (SCATTEREDISOPOINTS_USE_PARAVIEW)
  list(APPEND plugin_modules ScatteredIsopoints::vtkScatteredIsopointRepresentations)
  list(APPEND module_files "${CMAKE_CURRENT_SOURCE_DIR}/Plugin/Representation/vtk.module")
endif ()

vtk_module_scan(
  MODULE_FILES ${module_files}
  REQUEST_MODULES ${plugin_modules}
  PROVIDES_MODULES modules)
vtk_module_build(
  MODULES ${modules}
  PACKAGE ScatteredIsopoints
  INSTALL_EXPORT ScatteredIsopoints
  VERSION "${PROJECT_VERSION}"
  LIBRARY_NAME_SUFFIX ""
  INSTALL_HEADERS ON
  HEADERS_DESTINATION "${CMAKE_INSTALL_INCLUDEDIR}/scatteredisopoints"
  CMAKE_DESTINATION "${CMAKE_INSTALL_LIBDIR}/cmake/ScatteredIsopoints"
  HIERARCHY_DESTINATION "${CMAKE_INSTALL_LIBDIR}/vtk/hierarchy/ScatteredIsopoints")

include("CMake/CMakePackage.cmake")

set(SCATTEREDISOPOINTS_PLUGIN_SUBDIRECTORY "")
if (SCATTEREDISOPOINTS_PACKAGES)
  set(SCATTEREDISOPOINTS_PLUGIN_SUBDIRECTORY
    "paraview-${ParaView_VERSION_MAJOR}.${ParaView_VERSION_MINOR}/plugins")
  include("CMake/Packages.cmake")
endif ()

if (deliverables AND SCATTEREDISOPOINTS_USE_PARAVIEW)
  paraview_plugin_scan(
    PLUGIN_FILES "${CMAKE_CURRENT_SOURCE_DIR}/Plugin/paraview.plugin"
    PROVIDES_PLUGINS plugins
    ENABLE_BY_DEFAULT ON)
  paraview_plugin_build(
    PLUGINS ${plugins}
    AUTOLOAD ${plugins}
    LIBRARY_SUBDIRECTORY "${SCATTEREDISOPOINTS_PLUGIN_SUBDIRECTORY}"
    PLUGINS_FILE_NAME "scatteredisopoints.plugins.xml")
endif ()
