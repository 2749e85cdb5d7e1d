# The Python package `scatteredisopoints`: sources on the C library and, with VTK, the wrapped modules. It
# can be imported from the build folder. Under /usr/local, it is installed in the search path of Debian's
# python3.
execute_process(
  COMMAND "${Python3_EXECUTABLE}" -c
    "import os, sysconfig; print(os.path.basename(sysconfig.get_path('platlib')))"
  OUTPUT_VARIABLE python_packages
  OUTPUT_STRIP_TRAILING_WHITESPACE)
set(SCATTEREDISOPOINTS_PYTHON_DIR
  "lib/python${Python3_VERSION_MAJOR}.${Python3_VERSION_MINOR}/${python_packages}" CACHE STRING
  "Where the Python package is installed, relative to the prefix or absolute")
set(package "${SCATTEREDISOPOINTS_PYTHON_DIR}/scatteredisopoints")

# path_from_package(VARIABLE folder): relative path to an installed folder, so that the tree can be moved.
macro (path_from_package variable folder)
  file(RELATIVE_PATH ${variable} "/prefix/${package}" "/prefix/${folder}")
  string(REGEX REPLACE "/$" "" ${variable} "${${variable}}")
  if (NOT ${variable})
    set(${variable} ".")
  endif ()
endmacro ()
path_from_package(libraries_from_package "${CMAKE_INSTALL_LIBDIR}")

set(SCATTEREDISOPOINTS_PYTHON_BUILD_PATH "${CMAKE_BINARY_DIR}/${SCATTEREDISOPOINTS_PYTHON_DIR}")
set(built_package "${CMAKE_BINARY_DIR}/${package}")
file(GLOB python_sources RELATIVE "${CMAKE_CURRENT_SOURCE_DIR}/Python/scatteredisopoints" CONFIGURE_DEPENDS
  Python/scatteredisopoints/*.py)
# Beside the plugin in Python, ParaView would load these as plugins of their own.
foreach (name IN LISTS FILTER_NAMES)
  configure_file("${FILTER_PROPERTIES_DIR}/${name}.xml" "${built_package}/properties/${name}.xml" COPYONLY)
endforeach ()
configure_file(Plugin/IsopointSplatPolygons.xml "${built_package}/properties/IsopointSplatPolygons.xml" COPYONLY)
install(DIRECTORY "${built_package}/properties" DESTINATION "${package}" COMPONENT package)
set(python_plugin paraview/scattered_isopoints.py)
configure_file("Python/scatteredisopoints/${python_plugin}" "${built_package}/${python_plugin}" COPYONLY)
install(FILES "${built_package}/${python_plugin}" DESTINATION "${package}/paraview" COMPONENT package)
foreach (file IN LISTS python_sources ITEMS py.typed)
  configure_file("Python/scatteredisopoints/${file}" "${built_package}/${file}" COPYONLY)
  install(FILES "${built_package}/${file}" DESTINATION "${package}" COMPONENT package)
endforeach ()
path_from_package(plugin_from_package
  "${CMAKE_INSTALL_LIBDIR}/${SCATTEREDISOPOINTS_PLUGIN_SUBDIRECTORY}/ScatteredIsopoints/ScatteredIsopoints${CMAKE_SHARED_MODULE_SUFFIX}")
set(library_file "$<TARGET_SONAME_FILE_NAME:isopoint>")
if (WIN32)
  set(library_file "$<TARGET_FILE_NAME:isopoint>")
  path_from_package(libraries_from_package "${CMAKE_INSTALL_BINDIR}")
endif ()
set(library_from_package "${libraries_from_package}/${library_file}")
configure_file(Python/scatteredisopoints/_paths.py.in _paths.py.in @ONLY)
file(GENERATE OUTPUT "${built_package}/_paths.py" INPUT "${CMAKE_CURRENT_BINARY_DIR}/_paths.py.in")
install(FILES "${built_package}/_paths.py" DESTINATION "${package}" COMPONENT package)

if (NOT SCATTEREDISOPOINTS_VTK)
  return()
endif ()
vtk_module_wrap_python(
  MODULES ${python_modules}
  TARGET ScatteredIsopoints::ScatteredIsopointsPython
  PYTHON_PACKAGE "scatteredisopoints"
  MODULE_DESTINATION "${SCATTEREDISOPOINTS_PYTHON_DIR}"
  CMAKE_DESTINATION "${CMAKE_INSTALL_LIBDIR}/cmake/ScatteredIsopoints"
  INSTALL_HEADERS OFF)
if (APPLE)
  set(own_folder "@loader_path")
else ()
  set(own_folder "$ORIGIN")
endif ()
foreach (module IN LISTS python_modules)
  string(REPLACE "ScatteredIsopoints::" "" module "${module}")
  set_target_properties("${module}Python"
    PROPERTIES INSTALL_RPATH "${own_folder}/${libraries_from_package}")
endforeach ()
