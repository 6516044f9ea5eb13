# Installs into a folder of the build tree, then builds and runs a project that finds the package there.
# cmake -DBUILD=<build folder> -DSOURCE=<this folder> -P install_test.cmake
set(prefix ${BUILD}/tests/install/prefix)
file(REMOVE_RECURSE ${BUILD}/tests/install)
foreach(step
    "${CMAKE_COMMAND}\;--install\;${BUILD}\;--prefix\;${prefix}"
    "${CMAKE_COMMAND}\;-S\;${SOURCE}/consumer\;-B\;${BUILD}/tests/install/consumer\;-G\;Ninja\;-DCMAKE_PREFIX_PATH=${prefix}"
    "${CMAKE_COMMAND}\;--build\;${BUILD}/tests/install/consumer"
    "${BUILD}/tests/install/consumer/consumer")
  execute_process(COMMAND ${step} RESULT_VARIABLE result OUTPUT_VARIABLE output ERROR_VARIABLE output)
  if(NOT result EQUAL 0)
    message(FATAL_ERROR "${step}\n${output}")
  endif()
endforeach()
