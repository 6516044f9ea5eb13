cmake_minimum_required(VERSION 3.25)
# The pages of the public headers come out without a warning: no reference that leads nowhere, no parameter that a
# function does not have.
# cmake -DSOURCE=<project folder> -DPAGES=<folder for them> -P doxygen_test.cmake
find_program(DOXYGEN doxygen)
if(NOT DOXYGEN)
  message("skipped: doxygen is not installed")
  return()
endif()
file(REMOVE_RECURSE ${PAGES})
file(MAKE_DIRECTORY ${PAGES})
file(WRITE ${PAGES}/Doxyfile "@INCLUDE = docs/Doxyfile\nOUTPUT_DIRECTORY = ${PAGES}\n")
execute_process(COMMAND ${DOXYGEN} ${PAGES}/Doxyfile WORKING_DIRECTORY ${SOURCE}
                OUTPUT_VARIABLE said ERROR_VARIABLE said RESULT_VARIABLE status)
if(NOT status EQUAL 0)
  message(FATAL_ERROR "doxygen ends with ${status}:\n${said}")
endif()
# Comments above a namespace must have reached their headers' pages (docs/file_comments.awk).
foreach(page index.html namespaceespalier_1_1scenes.html sweep_8h.html)
  if(NOT EXISTS ${PAGES}/html/${page})
    message(FATAL_ERROR "doxygen wrote no ${page}:\n${said}")
  endif()
endforeach()
file(READ ${PAGES}/html/sweep_8h.html page)
if(NOT page MATCHES "Detailed Description")
  message(FATAL_ERROR "sim/sweep/sweep.h has lost the comment above its namespace")
endif()
