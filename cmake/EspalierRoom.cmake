# A room is a folder of sources, a library target espalier::<name>, and nothing that looks up the house.
set(CMAKE_CXX_STANDARD 20)
set(CMAKE_CXX_STANDARD_REQUIRED ON)
set(CMAKE_CXX_EXTENSIONS OFF)
set(CMAKE_EXPORT_COMPILE_COMMANDS ON)
set(CMAKE_POSITION_INDEPENDENT_CODE ON)

add_library(espalier_flags INTERFACE)
target_compile_options(espalier_flags INTERFACE
  $<BUILD_INTERFACE:-Wall;-Wextra;-Wshadow;-Wconversion;-Werror>
  # GCC 12 sees overlaps in "text" + string that are not there (GCC bug 105651).
  $<$<CXX_COMPILER_ID:GNU>:-Wno-restrict>
  # The same bytes on every machine: no fused multiply-add where the source says a*b+c.
  -ffp-contract=off)
if(ESPALIER_SANITIZE)
  target_compile_options(espalier_flags INTERFACE -fsanitize=${ESPALIER_SANITIZE} -fno-omit-frame-pointer)
  target_link_options(espalier_flags INTERFACE -fsanitize=${ESPALIER_SANITIZE})
endif()
set_target_properties(espalier_flags PROPERTIES EXPORT_NAME flags)

option(ESPALIER_JOINED_SOURCES "Compile each folder of a target as one, which takes two fifths of the time from scratch" OFF)

# espalier_join(TARGET [ALONE sources...]): compiles up to ten sources of one folder at once. Not sources that Highway compiles
# anew for each kind of processor, nor those that have to stand alone.
function(espalier_join target)
  cmake_parse_arguments(JOIN "" "" "ALONE" ${ARGN})
  if(NOT ESPALIER_JOINED_SOURCES)
    return()
  endif()
  set_target_properties(${target} PROPERTIES UNITY_BUILD ON UNITY_BUILD_MODE GROUP)
  get_target_property(sources ${target} SOURCES)
  foreach(source IN LISTS sources)
    cmake_path(ABSOLUTE_PATH source)
    file(STRINGS ${source} lanes REGEX "HWY_TARGET_INCLUDE" LIMIT_COUNT 1)
    cmake_path(GET source FILENAME name)
    if(lanes OR name IN_LIST JOIN_ALONE)
      continue()
    endif()
    cmake_path(GET source PARENT_PATH folder)
    cmake_path(RELATIVE_PATH folder BASE_DIRECTORY ${PROJECT_SOURCE_DIR})
    string(REPLACE "/" "_" group "${folder}")
    math(EXPR part "${in_${group}} + 0" OUTPUT_FORMAT DECIMAL)
    math(EXPR in_${group} "${part} + 1")
    math(EXPR part "${part} / 10")
    set_source_files_properties(${source} PROPERTIES UNITY_GROUP ${group}_${part})
  endforeach()
endfunction()

# espalier_room(NAME SEES targets... USES targets... [APART sources...] [ALONE sources...]): SEES is public, USES stays inside
# the room's .cpp files; APART are sources that are not of its library, ALONE those that are never compiled with others.
function(espalier_room name)
  cmake_parse_arguments(ROOM "" "" "SEES;USES;APART;ALONE" ${ARGN})
  file(GLOB_RECURSE sources CONFIGURE_DEPENDS ${CMAKE_CURRENT_SOURCE_DIR}/*.cpp)
  list(TRANSFORM ROOM_APART PREPEND ${CMAKE_CURRENT_SOURCE_DIR}/)
  list(REMOVE_ITEM sources ${ROOM_APART})
  add_library(espalier_${name} STATIC ${sources})
  add_library(espalier::${name} ALIAS espalier_${name})
  set_target_properties(espalier_${name} PROPERTIES EXPORT_NAME ${name})
  target_include_directories(espalier_${name} PUBLIC
    $<BUILD_INTERFACE:${PROJECT_SOURCE_DIR}> $<INSTALL_INTERFACE:include/espalier>)
  target_compile_features(espalier_${name} PUBLIC cxx_std_20)
  target_link_libraries(espalier_${name} PUBLIC ${ROOM_SEES} PRIVATE ${ROOM_USES} $<BUILD_INTERFACE:espalier_flags>)
  espalier_join(espalier_${name} ALONE ${ROOM_ALONE})
endfunction()
