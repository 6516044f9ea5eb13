# The page's own tests, by node alone: cmake -DNODE= -DPAGE= -DSOURCE= -DPROGRAM= -P page_units.cmake. The types hold, two
# bundlings give the same bytes as are in the program, and what reads texts, schemas and frames does so.
cmake_minimum_required(VERSION 3.25)
if(NOT NODE OR NOT EXISTS ${PAGE}/node_modules/typescript)
  message("skipped: node or the page's packages are not here")
  return()
endif()
execute_process(COMMAND ${NODE} node_modules/typescript/bin/tsc --noEmit WORKING_DIRECTORY ${PAGE} COMMAND_ERROR_IS_FATAL ANY)

set(again ${PAGE}/again)
file(REMOVE_RECURSE ${again})
file(COPY ${PAGE}/src ${PAGE}/build.mjs ${PAGE}/package.json ${PAGE}/tsconfig.json DESTINATION ${again})
file(CREATE_LINK ${PAGE}/node_modules ${again}/node_modules SYMBOLIC)
execute_process(COMMAND ${NODE} build.mjs files WORKING_DIRECTORY ${again} COMMAND_ERROR_IS_FATAL ANY)
foreach(file index.html app.js app.css licences.txt)
  execute_process(COMMAND ${CMAKE_COMMAND} -E compare_files ${PAGE}/files/${file} ${again}/files/${file} COMMAND_ERROR_IS_FATAL ANY)
endforeach()

file(GLOB tests ${SOURCE}/tests/studio/web/*.test.ts)
execute_process(COMMAND ${NODE} build.mjs --tests tests ${tests} WORKING_DIRECTORY ${PAGE} COMMAND_ERROR_IS_FATAL ANY)
set(ENV{ESPALIER_SOURCE} ${SOURCE})
set(ENV{ESPALIER_PROGRAM} ${PROGRAM})
file(GLOB bundled ${PAGE}/tests/*.mjs)
execute_process(COMMAND ${NODE} --test ${bundled} WORKING_DIRECTORY ${PAGE} COMMAND_ERROR_IS_FATAL ANY)
