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
# The library's rule sets are known by name to the program wherever it is.
file(WRITE ${work}/named.yaml "espalier: rules\nbase: column_climber_helix\notherwise: ivy\n")
step(${work}/prefix/bin/espalier check ${work}/named.yaml)
step(${work}/prefix/bin/espalier gallery figure_1 -o ${work}/gallery) # its scenes are found from where it is
file(RENAME ${work}/prefix/lib/espalier ${work}/hidden) # what draws is missed before the work, and only where it is needed
execute_process(COMMAND ${work}/prefix/bin/espalier grow ${work}/prefix/share/espalier/scenes/library/figure_2.yaml -o ${work}/undrawn
                RESULT_VARIABLE result OUTPUT_VARIABLE output ERROR_VARIABLE output)
if(NOT result EQUAL 2 OR NOT output MATCHES "cannot load the module that draws pictures" OR EXISTS ${work}/undrawn)
  message(FATAL_ERROR "without its module, exit ${result} and:\n${output}")
endif()
step(${work}/prefix/bin/espalier grow ${work}/prefix/share/espalier/scenes/library/figure_2.yaml --no-pictures -o ${work}/undrawn)
# A model with bark on it needs what draws, pictures or not.
execute_process(COMMAND ${work}/prefix/bin/espalier grow ${work}/prefix/share/espalier/scenes/library/figure_18.yaml --no-pictures -o ${work}/unpainted
                RESULT_VARIABLE result OUTPUT_VARIABLE output ERROR_VARIABLE output)
if(NOT result EQUAL 2 OR NOT output MATCHES "cannot load the module that draws pictures" OR EXISTS ${work}/unpainted)
  message(FATAL_ERROR "a painted model without its module, exit ${result} and:\n${output}")
endif()
file(RENAME ${work}/hidden ${work}/prefix/lib/espalier)
step(${CMAKE_COMMAND} -S ${SOURCE}/consumer -B ${work}/consumer -G Ninja -DCMAKE_PREFIX_PATH=${work}/prefix)
step(${CMAKE_COMMAND} --build ${work}/consumer)
step(${work}/consumer/consumer ${work}/prefix/share/espalier/scenes/meshes/street.obj)
execute_process(COMMAND ${work}/consumer/consumer ${work}/named.yaml RESULT_VARIABLE result ERROR_VARIABLE output)
if(NOT result EQUAL 2 OR NOT output MATCHES "named.yaml")
  message(FATAL_ERROR "of a file that is no mesh, exit ${result} and:\n${output}")
endif()
