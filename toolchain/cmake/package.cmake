# What is installed beside the programs, and the Debian package. toolchain/cross builds it.
set(SUPERCOIL_VERSION_SUFFIX "" CACHE STRING "For which Debian the package is, e.g. +deb12")
set(package_version ${supercoil_version}${SUPERCOIL_VERSION_SUFFIX})
set(package_files ${PROJECT_SOURCE_DIR}/toolchain/package)
set(documents ${CMAKE_INSTALL_DOCDIR})

# Debian wants manual pages and changelogs compressed, and without a time in them.
function(supercoil_install_compressed file folder)
  get_filename_component(name ${file} NAME)
  set(compressed ${PROJECT_BINARY_DIR}/compressed/${name}.gz)
  file(MAKE_DIRECTORY ${PROJECT_BINARY_DIR}/compressed)
  execute_process(COMMAND gzip -9nc ${file} OUTPUT_FILE ${compressed} COMMAND_ERROR_IS_FATAL ANY)
  set_property(DIRECTORY APPEND PROPERTY CMAKE_CONFIGURE_DEPENDS ${file})
  install(FILES ${compressed} DESTINATION ${folder})
endfunction()

foreach(section 1 8)
  file(GLOB pages CONFIGURE_DEPENDS ${PROJECT_SOURCE_DIR}/docs/man/*.${section})
  foreach(page IN LISTS pages)
    supercoil_install_compressed(${page} ${CMAKE_INSTALL_MANDIR}/man${section})
  endforeach()
endforeach()
configure_file(${package_files}/changelog.in ${PROJECT_BINARY_DIR}/changelog @ONLY)
supercoil_install_compressed(${PROJECT_BINARY_DIR}/changelog ${documents})
install(FILES ${package_files}/copyright DESTINATION ${documents})
install(DIRECTORY ${PROJECT_SOURCE_DIR}/docs/ DESTINATION ${documents} PATTERN man EXCLUDE)
install(FILES ${PROJECT_SOURCE_DIR}/examples/python/move_muscle.py ${PROJECT_SOURCE_DIR}/firmware/io/can/supercoil.dbc
        DESTINATION ${documents}/examples)

# Debian's zsh looks below /usr in another folder than below /usr/local.
set(zsh_folder site-functions)
if(CMAKE_INSTALL_PREFIX STREQUAL /usr)
  set(zsh_folder vendor-completions)
endif()
set(completion ${PROJECT_SOURCE_DIR}/firmware/apps/completion)
install(DIRECTORY ${completion}/bash/ DESTINATION ${CMAKE_INSTALL_DATADIR}/bash-completion/completions)
install(DIRECTORY ${completion}/zsh/ DESTINATION ${CMAKE_INSTALL_DATADIR}/zsh/${zsh_folder})
install(DIRECTORY ${completion}/fish/ DESTINATION ${CMAKE_INSTALL_DATADIR}/fish/vendor_completions.d)

# Files that the administrator may change: dpkg keeps what was changed. No board.toml among them: what is wired to a
# board, no default can know, and without it the service does not start.
file(GLOB boards CONFIGURE_DEPENDS ${PROJECT_SOURCE_DIR}/firmware/io/config/examples/*.toml)
set(conffiles "")
foreach(board IN LISTS boards)
  get_filename_component(name ${board} NAME)
  string(APPEND conffiles "/etc/supercoil/boards/${name}\n")
endforeach()
file(WRITE ${PROJECT_BINARY_DIR}/conffiles "${conffiles}")
# etc below the prefix, unless CMAKE_INSTALL_SYSCONFDIR is absolute, as it is for the package.
install(FILES ${boards} DESTINATION ${CMAKE_INSTALL_SYSCONFDIR}/supercoil/boards)

if(NOT PROJECT_IS_TOP_LEVEL)
  return()
endif()
set(CPACK_GENERATOR DEB)
# Without the libraries for other projects.
set(CPACK_INSTALL_CMAKE_PROJECTS "${CMAKE_BINARY_DIR};supercoil;Unspecified;/")
set(CPACK_PACKAGE_NAME supercoil)
set(CPACK_PACKAGE_VERSION ${package_version})
set(CPACK_PACKAGE_CONTACT "supercoil's maintainers <maintainers@supercoil.invalid>")
set(CPACK_PACKAGE_DESCRIPTION_SUMMARY "firmware and tools for super-coiled polymer artificial muscles")
set(CPACK_DEBIAN_PACKAGE_DESCRIPTION
"supercoil heats super-coiled polymer muscles (coils of silver-plated nylon
thread), learns their parameters while it runs, makes them follow a position,
reports on a CAN bus, and keeps them from burning.

supercoild is the firmware of a board, a service. supercoil is its operator's
tool. supercoil-sim runs the same firmware over a simulated muscle.")
set(CPACK_DEBIAN_FILE_NAME DEB-DEFAULT)
set(CPACK_DEBIAN_PACKAGE_SECTION electronics)
set(CPACK_DEBIAN_PACKAGE_SHLIBDEPS ON)
set(CPACK_DEBIAN_PACKAGE_DEPENDS systemd)
set(CPACK_DEBIAN_PACKAGE_RECOMMENDS "udev, gnuplot-nox | gnuplot")
set(CPACK_DEBIAN_PACKAGE_SUGGESTS "can-utils, gpiod, python3-can, supercoil-doc")
set(CPACK_DEBIAN_PACKAGE_CONTROL_EXTRA ${PROJECT_BINARY_DIR}/conffiles
    ${package_files}/postinst ${package_files}/prerm ${package_files}/postrm)
set(CPACK_DEBIAN_PACKAGE_CONTROL_STRICT_PERMISSION ON)
if(CMAKE_SYSTEM_PROCESSOR STREQUAL aarch64)
  set(CPACK_DEBIAN_PACKAGE_ARCHITECTURE arm64)
endif()
set(CPACK_STRIP_FILES ON)
# Some files go to /etc.
set(CPACK_SET_DESTDIR ON)
set(CPACK_INSTALL_PREFIX /usr)
set(CPACK_INSTALL_DEFAULT_DIRECTORY_PERMISSIONS
    OWNER_READ OWNER_WRITE OWNER_EXECUTE GROUP_READ GROUP_EXECUTE WORLD_READ WORLD_EXECUTE)
# The programs are built when they are packed, and nothing else is.
set(CMAKE_SKIP_INSTALL_ALL_DEPENDENCY ON)
include(CPack)
