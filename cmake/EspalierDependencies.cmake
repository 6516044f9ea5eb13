# Every library we stand on, by its Debian 12 package. The order matters in two places.
find_package(Threads REQUIRED)
find_package(TBB REQUIRED CONFIG) # before OpenVDB, whose own FindTBB would define half of TBB's export set
list(APPEND CMAKE_MODULE_PATH "/usr/lib/${CMAKE_LIBRARY_ARCHITECTURE}/cmake/OpenVDB") # Debian ships no OpenVDBConfig
find_package(OpenVDB REQUIRED)
list(REMOVE_ITEM CMAKE_MODULE_PATH "/usr/lib/${CMAKE_LIBRARY_ARCHITECTURE}/cmake/OpenVDB") # it shadows FindOpenEXR and others

find_package(OpenImageIO REQUIRED CONFIG)
foreach(property INTERFACE_INCLUDE_DIRECTORIES INTERFACE_SYSTEM_INCLUDE_DIRECTORIES)
  get_target_property(folders OpenImageIO::OpenImageIO ${property}) # Debian's target names a folder that does not exist
  if(folders)
    list(REMOVE_ITEM folders /usr/include/opencv4)
    set_target_properties(OpenImageIO::OpenImageIO PROPERTIES ${property} "${folders}")
  endif()
endforeach()

find_package(glm REQUIRED CONFIG)
find_package(assimp REQUIRED CONFIG)
find_package(draco REQUIRED CONFIG)
find_package(embree 3 REQUIRED CONFIG)
find_package(TinyGLTF REQUIRED CONFIG)
find_package(yaml-cpp REQUIRED CONFIG)
find_package(CLI11 REQUIRED CONFIG)
find_package(fmt REQUIRED CONFIG)
find_package(hwy REQUIRED CONFIG)
find_package(nlohmann_json REQUIRED CONFIG)
find_path(RANDOM123_INCLUDE_DIR Random123/philox.h REQUIRED)
find_path(KISSFFT_INCLUDE_DIR kissfft/kissfft.hh REQUIRED) # a template of the header alone: in double precision
find_path(XXHASH_INCLUDE_DIR xxhash.h REQUIRED)
find_library(XXHASH_LIBRARY xxhash REQUIRED)
find_path(NOVA_INCLUDE_DIR libnova/libnova.h REQUIRED) # the sun's place; no CMake package, no .pc
find_library(NOVA_LIBRARY nova REQUIRED)
