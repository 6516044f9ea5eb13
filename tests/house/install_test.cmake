# Installs into a folder of the build tree, draws with the program there, then builds and runs a project that finds the
# package there.
# cmake -DBUILD=<build folder> -DSOURCE=<this folder> -P install_test.cmake
cmake_minimum_required(VERSION 3.25)
set(work ${BUILD}/tests/install)
function(step)
  execute_process(COMMAND ${ARGV} RESULT_VARIABLE result OUTPUT_VARIABLE output ERROR_VARIABLE output)
  if(NOT result EQUAL 0)
    message(FATAL_ERROR "${ARGV}\n${output}")
  endif()
endfunction()

file(REMOVE_RECURSE ${work})
step(${CMAKE_COMMAND} --install ${BUILD} --prefix ${work}/prefix)
step(${work}/prefix/bin/espalier grow ${work}/prefix/share/espalier/scenes/library/figure_2.yaml -o ${work}/drawn)
step(${CMAKE_COMMAND} -S ${SOURCE}/consumer -B ${work}/consumer -G Ninja -DCMAKE_PREFIX_PATH=${work}/prefix)
step(${CMAKE_COMMAND} --build ${work}/consumer)
step(${work}/consumer/consumer ${work}/prefix/share/espalier/scenes/meshes/street.obj)
