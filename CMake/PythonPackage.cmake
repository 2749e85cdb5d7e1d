# The Python package `scatteredisopoints`: the wrapped modules, and an __init__.py that imports their
# classes. It can be imported from the build folder; installed under /usr/local, it is on the search
# path of Debian's python3, whose folder for packages has a name of its own.
execute_process(
  COMMAND "${Python3_EXECUTABLE}" -c
    "import os, sysconfig; print(os.path.basename(sysconfig.get_path('platlib')))"
  OUTPUT_VARIABLE python_packages
  OUTPUT_STRIP_TRAILING_WHITESPACE)
set(SCATTEREDISOPOINTS_PYTHON_DIR
  "lib/python${Python3_VERSION_MAJOR}.${Python3_VERSION_MINOR}/${python_packages}" CACHE STRING
  "Where the Python package is installed, relative to the prefix or absolute")

vtk_module_wrap_python(
  MODULES ${python_modules}
  TARGET ScatteredIsopoints::ScatteredIsopointsPython
  PYTHON_PACKAGE "scatteredisopoints"
  MODULE_DESTINATION "${SCATTEREDISOPOINTS_PYTHON_DIR}"
  CMAKE_DESTINATION "${CMAKE_INSTALL_LIBDIR}/cmake/ScatteredIsopoints"
  INSTALL_HEADERS OFF)

set(SCATTEREDISOPOINTS_PYTHON_BUILD_PATH "${CMAKE_BINARY_DIR}/${SCATTEREDISOPOINTS_PYTHON_DIR}")
set(built_package "${SCATTEREDISOPOINTS_PYTHON_BUILD_PATH}/scatteredisopoints")
foreach (file __init__.py contouring.py py.typed ray_tracing.py)
  configure_file("Filters/Python/${file}" "${built_package}/${file}" COPYONLY)
  list(APPEND python_sources "${built_package}/${file}")
endforeach ()
file(RELATIVE_PATH plugin_from_package
  "/prefix/${SCATTEREDISOPOINTS_PYTHON_DIR}/scatteredisopoints"
  "/prefix/${CMAKE_INSTALL_LIBDIR}/${SCATTEREDISOPOINTS_PLUGIN_SUBDIRECTORY}/ScatteredIsopoints/ScatteredIsopoints${CMAKE_SHARED_MODULE_SUFFIX}")
configure_file(Filters/Python/plugin.py.in "${built_package}/plugin.py" @ONLY)
install(FILES ${python_sources} "${built_package}/plugin.py"
  DESTINATION "${SCATTEREDISOPOINTS_PYTHON_DIR}/scatteredisopoints")

# A relative run path from the package to the libraries, so that the installed tree can be moved.
file(RELATIVE_PATH libraries_from_package
  "/prefix/${SCATTEREDISOPOINTS_PYTHON_DIR}/scatteredisopoints" "/prefix/${CMAKE_INSTALL_LIBDIR}")
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
