# Adds headings to the pages that ParaView makes of the filters' documentation, and a picture with its caption:
#
#   cmake -DPAGES_DIR=... -DPICTURES_DIR=... -P FormatHelp.cmake
#
# ParaView starts paragraphs at blank lines; bold paragraphs become headings.
string(CONCAT comparison "A sphere from a million random samples. Left: Scattered Isopoints. "
  "Middle: the same points as Point Gaussian. Right: Contour after resampling to 100 x 100 x 100 nodes.")
set(slice "Temperatures in a ball, sliced by a plane.")
set(line "Temperatures over a line.")
set(grid "An image of temperatures, as a volume.")
set(gradient "Gradients of temperatures, as arrows of Glyph.")
set(body "The surface of the hottest samples of a cloud, from their positions alone.")
set(probe "Temperatures at the points of a torus.")
file(GLOB pages "${PAGES_DIR}/filters.*.html")
foreach (page IN LISTS pages)
  file(READ "${page}" text)
  string(REGEX REPLACE "<p>\n *<b>([^<]+)</b>\n<p>" "<h3>\\1</h3>\n<p>" text "${text}")
  set(name comparison)
  set(picture comparison.png)
  set(width 600)
  if (page MATCHES "Scattered(Slice|Line|Grid|Gradient|Probe|Body)")
    string(TOLOWER "${CMAKE_MATCH_1}" name)
    set(picture "filters_${name}.png")
    set(width 320)
    file(COPY "${PICTURES_DIR}/examples/${picture}" DESTINATION "${PAGES_DIR}")
  else ()
    file(COPY "${PICTURES_DIR}/${picture}" DESTINATION "${PAGES_DIR}")
  endif ()
  string(REPLACE "</div>\n"
    "</div>\n<p><img src=\"${picture}\" width=\"${width}\"/><br/><i>${${name}}</i></p>\n" text "${text}")
  file(WRITE "${page}" "${text}")
endforeach ()
