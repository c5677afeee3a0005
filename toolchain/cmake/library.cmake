# How other projects find the libraries: find_package(supercoil) and pkg-config (docs/library.md).
include(CMakePackageConfigHelpers)

set(headers ${CMAKE_INSTALL_INCLUDEDIR})
# The firmware's headers include each other with their folder: "loop/loop.hpp".
set(firmware_headers ${CMAKE_INSTALL_INCLUDEDIR}/supercoil/firmware)
install(DIRECTORY control/include/ hal/include/ DESTINATION ${headers} COMPONENT development)
install(DIRECTORY firmware/core/ firmware/io/ DESTINATION ${firmware_headers} COMPONENT development
        FILES_MATCHING PATTERN *.hpp PATTERN linux_board EXCLUDE PATTERN plot EXCLUDE)

foreach(library control hal core io firmware can_client)
  set_target_properties(supercoil_${library} PROPERTIES EXPORT_NAME ${library})
endforeach()
target_include_directories(supercoil_control INTERFACE $<INSTALL_INTERFACE:${headers}>)
target_include_directories(supercoil_hal INTERFACE $<INSTALL_INTERFACE:${headers}>)
target_include_directories(supercoil_core INTERFACE $<INSTALL_INTERFACE:${firmware_headers}>)

# Two files, because a project that uses only control needs only Eigen.
set(config_folder ${CMAKE_INSTALL_LIBDIR}/cmake/supercoil)
install(TARGETS supercoil_control EXPORT control ARCHIVE DESTINATION ${CMAKE_INSTALL_LIBDIR} COMPONENT development)
install(TARGETS supercoil_hal supercoil_core supercoil_io supercoil_firmware supercoil_can_client
        EXPORT firmware ARCHIVE DESTINATION ${CMAKE_INSTALL_LIBDIR} COMPONENT development)
foreach(part control firmware)
  install(EXPORT ${part} FILE supercoil-${part}.cmake NAMESPACE supercoil:: DESTINATION ${config_folder}
          COMPONENT development)
endforeach()
# In 0.x the libraries' interface changes with the minor version.
write_basic_package_version_file(${PROJECT_BINARY_DIR}/supercoil-config-version.cmake COMPATIBILITY SameMinorVersion)
install(FILES toolchain/cmake/supercoil-config.cmake ${PROJECT_BINARY_DIR}/supercoil-config-version.cmake
        DESTINATION ${config_folder} COMPONENT development)

# Relative paths, so that they work with any --prefix.
set(pkgconfig_folder ${CMAKE_INSTALL_LIBDIR}/pkgconfig)
file(RELATIVE_PATH to_prefix /${pkgconfig_folder} /)
function(install_pkg_config name description requires libraries flags)
  configure_file(${PROJECT_SOURCE_DIR}/toolchain/cmake/pkg-config.pc.in ${PROJECT_BINARY_DIR}/${name}.pc @ONLY)
  install(FILES ${PROJECT_BINARY_DIR}/${name}.pc DESTINATION ${pkgconfig_folder} COMPONENT development)
endfunction()
install_pkg_config(supercoil-control "Controllers, estimators and thermal observers for super-coiled polymer muscles"
                   "eigen3 >= 3.4" "-lsupercoil_control" "-I\${includedir} -DEIGEN_DONT_VECTORIZE")
install_pkg_config(supercoil-firmware "The control loop of a board that drives super-coiled polymer muscles"
                   "supercoil-control, tomlplusplus" "-lsupercoil_io -lsupercoil_core" "-I\${includedir}/supercoil/firmware")
install_pkg_config(supercoil-can-client "Commands boards that drive super-coiled polymer muscles, over CAN"
                   "supercoil-firmware" "-lsupercoil_can_client" "-I\${includedir}/supercoil/firmware")
