# ParaView, with the VTK that it brings, or VTK alone.
if (SCATTEREDISOPOINTS_USE_PARAVIEW)
  find_package(ParaView REQUIRED)
else ()
  # Named, since otherwise all that VTK was built with is asked for, Qt included.
  set(vtk_components
    CommonCore CommonDataModel CommonExecutionModel CommonMath CommonMisc ParallelCore
    RenderingCore RenderingOpenGL2 vtksys)
  set(wrapping_components Python WrappingPythonCore WrappingTools)
  set(test_components FiltersCore IOGeometry IOXML)
  find_package(VTK REQUIRED
    COMPONENTS ${vtk_components} ${wrapping_components} ${test_components}
    OPTIONAL_COMPONENTS FiltersPoints glad glew)
endif ()
