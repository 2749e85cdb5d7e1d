# The Python package `scatteredisopoints`: the wrapped modules, and an __init__.py that names their
# classes. It is importable from the build folder and, installed, from Debian's own place.
set(SCATTEREDISOPOINTS_PYTHON_DIR "${CMAKE_INSTALL_LIBDIR}/python3/dist-packages" CACHE STRING
  "Where the Python package is installed, relative to the prefix or absolute")

vtk_module_wrap_python(
  MODULES ${modules}
  TARGET ScatteredIsopoints::ScatteredIsopointsPython
  PYTHON_PACKAGE "scatteredisopoints"
  MODULE_DESTINATION "${SCATTEREDISOPOINTS_PYTHON_DIR}"
  CMAKE_DESTINATION "${CMAKE_INSTALL_LIBDIR}/cmake/ScatteredIsopoints"
  INSTALL_HEADERS OFF)

set(package_source "${CMAKE_CURRENT_SOURCE_DIR}/Filters/Python/__init__.py")
set(SCATTEREDISOPOINTS_PYTHON_BUILD_PATH "${CMAKE_BINARY_DIR}/${SCATTEREDISOPOINTS_PYTHON_DIR}")
configure_file("${package_source}"
  "${SCATTEREDISOPOINTS_PYTHON_BUILD_PATH}/scatteredisopoints/__init__.py" COPYONLY)
install(FILES "${package_source}"
  DESTINATION "${SCATTEREDISOPOINTS_PYTHON_DIR}/scatteredisopoints")
