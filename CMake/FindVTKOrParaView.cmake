# Finds ParaView with its VTK, or VTK alone.
if (SCATTEREDISOPOINTS_USE_PARAVIEW)
  find_package(ParaView REQUIRED)
else ()
  # Without components, everything that VTK was built with is required, including Qt.
  set(vtk_components
    CommonCore CommonDataModel CommonExecutionModel CommonMath CommonMisc ParallelCore
    RenderingCore RenderingOpenGL2 vtksys)
  set(wrapping_components Python WrappingPythonCore WrappingTools)
  set(test_components FiltersCore IOXML)
  find_package(VTK REQUIRED
    COMPONENTS ${vtk_components} ${wrapping_components} ${test_components}
    OPTIONAL_COMPONENTS FiltersPoints glad glew)
endif ()
