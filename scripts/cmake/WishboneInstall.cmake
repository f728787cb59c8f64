include(CMakePackageConfigHelpers)

install(TARGETS wishbone EXPORT wishboneTargets
  ARCHIVE DESTINATION ${CMAKE_INSTALL_LIBDIR}
  LIBRARY DESTINATION ${CMAKE_INSTALL_LIBDIR})
install(TARGETS wishbone_command RUNTIME DESTINATION ${CMAKE_INSTALL_BINDIR})
foreach(room IN ITEMS core bodies joints forces identification solver models)
  install(DIRECTORY ${PROJECT_SOURCE_DIR}/${room}
    DESTINATION ${CMAKE_INSTALL_INCLUDEDIR}/wishbone FILES_MATCHING PATTERN "*.h"
    # private: the first needs the headers of SUNDIALS, the others are halves of loaders
    PATTERN sundials.h EXCLUDE PATTERN scene_sections.h EXCLUDE PATTERN identification_sections.h EXCLUDE PATTERN scenes EXCLUDE
    REGEX models/identification$ EXCLUDE)
endforeach()
install(DIRECTORY ${PROJECT_SOURCE_DIR}/models/scenes ${PROJECT_SOURCE_DIR}/models/identification
  DESTINATION ${CMAKE_INSTALL_DATADIR}/wishbone)

set(config_dir ${CMAKE_INSTALL_LIBDIR}/cmake/wishbone)
install(EXPORT wishboneTargets NAMESPACE wishbone:: DESTINATION ${config_dir})
configure_package_config_file(${CMAKE_CURRENT_LIST_DIR}/wishboneConfig.cmake.in
  ${CMAKE_CURRENT_BINARY_DIR}/wishboneConfig.cmake INSTALL_DESTINATION ${config_dir})
write_basic_package_version_file(${CMAKE_CURRENT_BINARY_DIR}/wishboneConfigVersion.cmake
  COMPATIBILITY SameMinorVersion)
install(FILES ${CMAKE_CURRENT_BINARY_DIR}/wishboneConfig.cmake
              ${CMAKE_CURRENT_BINARY_DIR}/wishboneConfigVersion.cmake
              ${CMAKE_CURRENT_LIST_DIR}/WishboneDependencies.cmake
  DESTINATION ${config_dir})
