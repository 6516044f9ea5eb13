# `find_package(espalier)` from a tree outside this one: espalier::sim, ::rules, ::render, ::scenes.
include(GNUInstallDirs)
include(CMakePackageConfigHelpers)

set(package_folder ${CMAKE_INSTALL_LIBDIR}/cmake/espalier)
install(TARGETS espalier_flags espalier_sim espalier_rules espalier_render espalier_scenes espalier EXPORT espalier)
install(TARGETS espalier_oiio DESTINATION lib/espalier)
set_target_properties(espalier PROPERTIES INSTALL_RPATH "$ORIGIN/../lib/espalier")
foreach(room sim rules render scenes)
  install(DIRECTORY ${room} DESTINATION ${CMAKE_INSTALL_INCLUDEDIR}/espalier FILES_MATCHING PATTERN "*.h")
endforeach()
install(FILES cmake/espalier.h DESTINATION ${CMAKE_INSTALL_INCLUDEDIR}/espalier)
install(DIRECTORY rules/library DESTINATION ${CMAKE_INSTALL_DATADIR}/espalier/rules)
install(DIRECTORY scenes/library scenes/meshes scenes/skeletons DESTINATION ${CMAKE_INSTALL_DATADIR}/espalier/scenes)
# Of what the studio's page is made of; not there where the page was left out.
install(FILES ${PROJECT_BINARY_DIR}/studio/page/files/licences.txt DESTINATION ${CMAKE_INSTALL_DOCDIR} OPTIONAL)
install(EXPORT espalier NAMESPACE espalier:: DESTINATION ${package_folder} FILE espalierTargets.cmake)
write_basic_package_version_file(${PROJECT_BINARY_DIR}/espalierConfigVersion.cmake COMPATIBILITY SameMinorVersion)
install(FILES ${PROJECT_BINARY_DIR}/espalierConfigVersion.cmake cmake/espalierConfig.cmake
              cmake/EspalierDependencies.cmake
        DESTINATION ${package_folder})
