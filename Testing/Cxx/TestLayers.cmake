# Fails where a layer includes what it must not know.
function (forbid folder pattern reason)
  file(GLOB_RECURSE files "${SOURCE_DIR}/${folder}/*.h" "${SOURCE_DIR}/${folder}/*.cxx")
  if (NOT files)
    message(FATAL_ERROR "no sources found in ${SOURCE_DIR}/${folder}")
  endif ()
  foreach (file IN LISTS files)
    file(STRINGS "${file}" found REGEX "#include *[\"<]${pattern}")
    if (found)
      message(SEND_ERROR "${file}: ${found}\n${reason}")
    endif ()
  endforeach ()
endfunction ()

forbid(Filters/Isopoint "(vtk|\\.\\./)" "The algorithm knows no VTK.")
forbid(Filters "vtk[A-Za-z]*(OpenGL|Render|Mapper|Actor|Shader|Camera)" "Filters know no rendering.")
forbid(Rendering "(vtkScatteredIsopointFilter|Isopoint/|vtkIsopoint(Arrays|Execution|Input|Placement))"
  "The mapper knows no filter.")
