# The page in a real browser: cmake -DNODE= -DPAGE= -DSOURCE= -DPROGRAM= -DSCRATCH= -P page_browser.cmake.
cmake_minimum_required(VERSION 3.25)
if(NOT NODE)
  message("skipped: node is not here")
  return()
endif()
execute_process(COMMAND ${NODE} ${CMAKE_CURRENT_LIST_DIR}/page_test.mjs ${PROGRAM} ${SOURCE} ${PAGE} ${SCRATCH} COMMAND_ERROR_IS_FATAL ANY)
