# Packages of the installed tree, by `cmake --build --preset package --target package`: a relocatable
# archive, and on Debian a .deb whose plugin ParaView lists and loads like its own.
set(CPACK_PACKAGE_NAME "scattered-isopoints")
set(CPACK_PACKAGE_VENDOR "Scattered Isopoints developers")
set(CPACK_PACKAGE_CONTACT "Scattered Isopoints developers <scattered-isopoints@localhost>")
set(CPACK_PACKAGE_DESCRIPTION_SUMMARY "Isosurfaces straight from scattered samples, for ParaView and VTK")
set(CPACK_RESOURCE_FILE_LICENSE "${CMAKE_CURRENT_SOURCE_DIR}/LICENSE")
set(CPACK_STRIP_FILES ON)
set(CPACK_GENERATOR TGZ)
set(CPACK_THREADS 0)

file(STRINGS /etc/os-release distribution REGEX "^(ID|VERSION_ID)=")
if (distribution MATCHES "VERSION_ID=\"([0-9]+)\"")
  set(debian_release "deb${CMAKE_MATCH_1}")
elseif (distribution STREQUAL "ID=debian")
  set(debian_release sid)
endif ()
if (debian_release AND EXISTS /etc/debian_version)
  set(CPACK_DEBIAN_PACKAGE_RELEASE "1~${debian_release}")
  list(APPEND CPACK_GENERATOR DEB)
endif ()
set(CPACK_DEBIAN_FILE_NAME DEB-DEFAULT)
set(CPACK_DEBIAN_PACKAGE_SECTION science)
set(CPACK_DEBIAN_PACKAGE_DESCRIPTION
  "A ParaView plugin, VTK modules and a Python package that extract isosurfaces, as points with
 normals and radii or as triangles, slices, values and bodies from samples without a mesh.")
# Adds the libraries linked, including the version of ParaView.
set(CPACK_DEBIAN_PACKAGE_SHLIBDEPS ON)
set(CPACK_DEBIAN_PACKAGE_SHLIBDEPS_PRIVATE_DIRS "${CMAKE_LIBRARY_OUTPUT_DIRECTORY}")
# For py3clean in CMake/prerm.
set(CPACK_DEBIAN_PACKAGE_DEPENDS "python3-paraview, python3-numpy, python3-minimal")
set(CPACK_DEBIAN_PACKAGE_SUGGESTS "paraview-dev")

set(plugins_folder "${CMAKE_INSTALL_FULL_LIBDIR}/${SCATTEREDISOPOINTS_PLUGIN_SUBDIRECTORY}")
configure_file(CMake/DebianPluginList.cmake.in "${CMAKE_BINARY_DIR}/DebianPluginList.cmake" @ONLY)
set(CPACK_PRE_BUILD_SCRIPTS "${CMAKE_BINARY_DIR}/DebianPluginList.cmake")
file(WRITE "${CMAKE_BINARY_DIR}/triggers" "activate-noawait ldconfig\n")
set(CPACK_DEBIAN_PACKAGE_CONTROL_EXTRA
  "${CMAKE_BINARY_DIR}/triggers" "${CMAKE_CURRENT_SOURCE_DIR}/CMake/prerm")
set(CPACK_DEBIAN_PACKAGE_CONTROL_STRICT_PERMISSION ON)

install(FILES LICENSE RENAME copyright DESTINATION "${CMAKE_INSTALL_DATAROOTDIR}/doc/${CPACK_PACKAGE_NAME}")
install(FILES CHANGELOG.md DESTINATION "${CMAKE_INSTALL_DATAROOTDIR}/doc/${CPACK_PACKAGE_NAME}")

include(CPack)
