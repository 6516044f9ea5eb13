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

# espalier_room(NAME SEES targets... USES targets...): SEES is public, USES stays inside the room's .cpp files.
function(espalier_room name)
  cmake_parse_arguments(ROOM "" "" "SEES;USES" ${ARGN})
  file(GLOB_RECURSE sources CONFIGURE_DEPENDS ${CMAKE_CURRENT_SOURCE_DIR}/*.cpp)
  add_library(espalier_${name} STATIC ${sources})
  add_library(espalier::${name} ALIAS espalier_${name})
  set_target_properties(espalier_${name} PROPERTIES EXPORT_NAME ${name})
  target_include_directories(espalier_${name} PUBLIC
    $<BUILD_INTERFACE:${PROJECT_SOURCE_DIR}> $<INSTALL_INTERFACE:include/espalier>)
  target_link_libraries(espalier_${name} PUBLIC ${ROOM_SEES} PRIVATE ${ROOM_USES} $<BUILD_INTERFACE:espalier_flags>)
endfunction()
