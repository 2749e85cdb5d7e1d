# Installs to a fresh prefix; Python package, plugin and CMake package must work from there alone.
function (run)
  execute_process(COMMAND ${ARGN} RESULT_VARIABLE result)
  if (NOT result EQUAL 0)
    message(FATAL_ERROR "failed: ${ARGN}")
  endif ()
endfunction ()

file(REMOVE_RECURSE "${PREFIX}")
run("${CMAKE_COMMAND}" --install "${BUILD_DIR}" --prefix "${PREFIX}" --component development)
foreach (file include/isopoint.h "${LIB_DIR}/cmake/isopoint/isopointConfig.cmake" "${LIB_DIR}/pkgconfig/isopoint.pc")
  if (NOT EXISTS "${PREFIX}/${file}")
    message(FATAL_ERROR "The component development lacks ${file}.")
  endif ()
endforeach ()
run("${CMAKE_COMMAND}" --install "${BUILD_DIR}" --prefix "${PREFIX}")
run("${CMAKE_COMMAND}" -E env "PYTHONPATH=${PREFIX}/${PYTHON_DIR}"
  "${PYTHON}" "${SOURCE_DIR}/Testing/Python/TestContour.py")
file(REMOVE_RECURSE "${PREFIX}-consumer")
run("${CMAKE_CTEST_COMMAND}" --build-and-test "${SOURCE_DIR}/Testing/Consumer" "${PREFIX}-consumer"
  --build-generator "${GENERATOR}" --build-options "-DCMAKE_PREFIX_PATH=${PREFIX}"
  --test-command "${CMAKE_CTEST_COMMAND}" --output-on-failure)
run("${OFFSCREEN}" "${PVPYTHON}" "${SOURCE_DIR}/Testing/ParaView/TestPipeline.py"
  "${PREFIX}/${LIB_DIR}/ScatteredIsopoints/ScatteredIsopoints.so")
