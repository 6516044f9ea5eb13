include(${CMAKE_CURRENT_LIST_DIR}/EspalierDependencies.cmake)
include(${CMAKE_CURRENT_LIST_DIR}/espalierTargets.cmake)
