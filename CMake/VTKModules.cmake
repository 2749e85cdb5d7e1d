# Everything that needs VTK or ParaView, except the Python package: modules, ray tracer and plugin.

# Ray tracing needs Embree 4 or 3.
find_package(embree 4 QUIET)
if (NOT embree_FOUND)
  find_package(embree 3 QUIET)
endif ()
if (embree_FOUND)
  string(REGEX MATCH "^[0-9]+" SCATTEREDISOPOINTS_EMBREE_VERSION "${embree_VERSION}")
  set(SCATTEREDISOPOINTS_EMBREE embree)
  message(STATUS "Rays are traced with Embree ${embree_VERSION}")
else ()
  message(STATUS "The ray tracer is not built: Embree 3 or 4 is missing")
endif ()

set(python_modules
  ScatteredIsopoints::vtkScatteredIsopointFilters
  ScatteredIsopoints::vtkScatteredIsopointRendering)
set(module_files
  "${CMAKE_CURRENT_SOURCE_DIR}/Filters/vtk.module"
  "${CMAKE_CURRENT_SOURCE_DIR}/Rendering/vtk.module")
if (embree_FOUND)
  list(APPEND python_modules ScatteredIsopoints::vtkScatteredIsopointRayTracing)
  list(APPEND module_files "${CMAKE_CURRENT_SOURCE_DIR}/RayTracing/vtk.module")
endif ()
set(plugin_modules ${python_modules})
if (SCATTEREDISOPOINTS_USE_PARAVIEW)
  list(APPEND plugin_modules ScatteredIsopoints::vtkScatteredIsopointRepresentations)
  list(APPEND module_files "${CMAKE_CURRENT_SOURCE_DIR}/Plugin/Representation/vtk.module")
  if (embree_FOUND)
    list(APPEND plugin_modules ScatteredIsopoints::vtkScatteredIsopointExporters)
    list(APPEND module_files "${CMAKE_CURRENT_SOURCE_DIR}/Plugin/Exporter/vtk.module")
  endif ()
endif ()

if (embree_FOUND)
  add_subdirectory(RayTracing/Tracer)
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
