# Adds headings to the pages that ParaView makes of the filters' documentation, and a picture with its caption to
# those of isosurfaces:
#
#   cmake -DPAGES_DIR=... -DPICTURE=... -P FormatHelp.cmake
#
# ParaView starts paragraphs at blank lines; bold paragraphs become headings.
file(COPY "${PICTURE}" DESTINATION "${PAGES_DIR}")
get_filename_component(picture "${PICTURE}" NAME)
string(CONCAT caption "A sphere from a million random samples. Left: Scattered Isopoints. "
  "Middle: the same points as Point Gaussian. Right: Contour after resampling to 100 x 100 x 100 nodes.")
file(GLOB pages "${PAGES_DIR}/filters.*.html")
foreach (page IN LISTS pages)
  file(READ "${page}" text)
  string(REGEX REPLACE "<p>\n *<b>([^<]+)</b>\n<p>" "<h3>\\1</h3>\n<p>" text "${text}")
  if (page MATCHES "Isopoint|Isosurface")
    string(REPLACE "</div>\n"
      "</div>\n<p><img src=\"${picture}\" width=\"600\"/><br/><i>${caption}</i></p>\n" text "${text}")
  endif ()
  file(WRITE "${page}" "${text}")
endforeach ()
