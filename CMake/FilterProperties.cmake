# Writes the properties of both filters as XML, from Plugin/ScatteredFilter.xml.in, for ParaView's plugin
# and the Python package: ${FILTER_PROPERTIES_DIR}/NAME.xml.
set(FILTER_PROPERTIES_DIR "${CMAKE_BINARY_DIR}/properties")
function (configure_filter filter name label kind other_kind)
  file(READ "${PROJECT_SOURCE_DIR}/Plugin/ScatteredFilter.xml.in" text)
  string(ASCII 1 begin)
  string(ASCII 2 end)
  string(REPLACE "<${other_kind}>" "${begin}" text "${text}")
  string(REPLACE "</${other_kind}>" "${end}" text "${text}")
  string(REGEX REPLACE "${begin}[^${end}]*${end}\n?" "" text "${text}")
  string(REGEX REPLACE "</?${kind}>\n?" "" text "${text}")
  string(CONFIGURE "${text}" text @ONLY)
  # Copying unchanged content keeps the time stamp, so that nothing is rebuilt.
  file(WRITE "${FILTER_PROPERTIES_DIR}/${name}.xml.new" "${text}")
  configure_file("${FILTER_PROPERTIES_DIR}/${name}.xml.new" "${FILTER_PROPERTIES_DIR}/${name}.xml" COPYONLY)
endfunction ()
set_property(DIRECTORY APPEND PROPERTY CMAKE_CONFIGURE_DEPENDS Plugin/ScatteredFilter.xml.in)
configure_filter(Isopoint ScatteredIsopoints "Scattered Isopoints" points triangles)
configure_filter(Isosurface ScatteredIsosurface "Scattered Isosurface" triangles points)
