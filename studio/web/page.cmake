# The page in the program: npm fetches what it is made from, node bundles it, and the files are put into the library as
# they are. All of that happens in the build tree. Where node or npm is missing, or npm can fetch nothing, the program is
# built without its page and says so; nothing else fails.
find_program(ESPALIER_NODE node)
find_program(ESPALIER_NPM npm)
set(ESPALIER_PAGE ${PROJECT_BINARY_DIR}/studio/page)
set(page_node "")
if(ESPALIER_NODE AND ESPALIER_NPM)
  execute_process(COMMAND ${ESPALIER_NODE} --version OUTPUT_VARIABLE version OUTPUT_STRIP_TRAILING_WHITESPACE ERROR_QUIET)
  string(REGEX REPLACE "^v" "" version "${version}")
  if(version VERSION_GREATER_EQUAL 18)
    set(page_node ${ESPALIER_NODE})
  endif()
endif()
if(NOT page_node)
  message(STATUS "espalier studio without its page: node 18 or newer and npm are not both here")
endif()

# What failed for want of a network is tried again with the next configuration.
if(EXISTS ${ESPALIER_PAGE}/fetched.txt)
  file(STRINGS ${ESPALIER_PAGE}/fetched.txt fetched LIMIT_COUNT 1)
  if(fetched STREQUAL "no")
    file(REMOVE ${ESPALIER_PAGE}/fetched.txt)
  endif()
endif()

set(web ${CMAKE_CURRENT_LIST_DIR})
add_custom_command(OUTPUT ${ESPALIER_PAGE}/fetched.txt
  COMMAND ${CMAKE_COMMAND} -DNODE=${page_node} -DNPM=${ESPALIER_NPM} -DWEB=${web} -DPAGE=${ESPALIER_PAGE}
          -DTESTS=${ESPALIER_TESTS} -P ${web}/fetch.cmake
  DEPENDS ${web}/package.json ${web}/package-lock.json ${web}/.npmrc ${web}/fetch.cmake
  COMMENT "Fetching what the studio's page is made from" VERBATIM)

file(GLOB_RECURSE page_sources CONFIGURE_DEPENDS ${web}/src/* ${web}/presets/*)
add_custom_command(OUTPUT ${ESPALIER_PAGE}/page_files.cpp
  COMMAND ${CMAKE_COMMAND} -DNODE=${page_node} -DWEB=${web} -DPAGE=${ESPALIER_PAGE} -P ${web}/embed.cmake
  DEPENDS ${ESPALIER_PAGE}/fetched.txt ${page_sources} ${web}/build.mjs ${web}/tsconfig.json ${web}/embed.cmake
  COMMENT "Bundling the studio's page" VERBATIM)

target_sources(espalier_studio PRIVATE ${ESPALIER_PAGE}/page_files.cpp)
set_source_files_properties(${ESPALIER_PAGE}/page_files.cpp PROPERTIES SKIP_UNITY_BUILD_INCLUSION ON)
