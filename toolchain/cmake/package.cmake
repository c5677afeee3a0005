# Files installed with the programs. The components are Debian's packages (toolchain/debian/source): board, which is the
# default, and simulator; toolchain/cmake/library.cmake has the third one, development.
set(documents ${CMAKE_INSTALL_DOCDIR})

# Debian requires manual pages to be compressed, without a time stamp.
function(supercoil_install_compressed file folder component)
  get_filename_component(name ${file} NAME)
  set(compressed ${PROJECT_BINARY_DIR}/compressed/${name}.gz)
  file(MAKE_DIRECTORY ${PROJECT_BINARY_DIR}/compressed)
  execute_process(COMMAND gzip -9nc ${file} OUTPUT_FILE ${compressed} COMMAND_ERROR_IS_FATAL ANY)
  set_property(DIRECTORY APPEND PROPERTY CMAKE_CONFIGURE_DEPENDS ${file})
  install(FILES ${compressed} DESTINATION ${folder} COMPONENT ${component})
endfunction()

foreach(section 1 8)
  file(GLOB pages CONFIGURE_DEPENDS ${PROJECT_SOURCE_DIR}/docs/man/*.${section})
  foreach(page IN LISTS pages)
    set(component board)
    if(page MATCHES "/supercoil-sim[^/]*$")
      set(component simulator)
    endif()
    supercoil_install_compressed(${page} ${CMAKE_INSTALL_MANDIR}/man${section} ${component})
  endforeach()
endforeach()
install(DIRECTORY ${PROJECT_SOURCE_DIR}/docs/ DESTINATION ${documents} PATTERN man EXCLUDE)
install(CODE "
  set(documents \"\$ENV{DESTDIR}\${CMAKE_INSTALL_PREFIX}/${documents}\")
  include(\"${PROJECT_SOURCE_DIR}/toolchain/cmake/installed_links.cmake\")")
install(FILES ${PROJECT_SOURCE_DIR}/examples/python/move_muscle.py ${PROJECT_SOURCE_DIR}/firmware/io/can/supercoil.dbc
        DESTINATION ${documents}/examples)

# Debian's zsh searches different folders below /usr and below /usr/local.
set(zsh_folder site-functions)
if(CMAKE_INSTALL_PREFIX STREQUAL /usr)
  set(zsh_folder vendor-completions)
endif()
set(completion ${PROJECT_SOURCE_DIR}/firmware/apps/completion)
function(supercoil_install_completion shell folder)
  install(DIRECTORY ${completion}/${shell}/ DESTINATION ${folder} PATTERN *supercoil-sim* EXCLUDE)
  install(DIRECTORY ${completion}/${shell}/ DESTINATION ${folder} COMPONENT simulator FILES_MATCHING PATTERN *supercoil-sim*)
endfunction()
supercoil_install_completion(bash ${CMAKE_INSTALL_DATADIR}/bash-completion/completions)
supercoil_install_completion(zsh ${CMAKE_INSTALL_DATADIR}/zsh/${zsh_folder})
supercoil_install_completion(fish ${CMAKE_INSTALL_DATADIR}/fish/vendor_completions.d)

# Files that the administrator may change: dpkg keeps the changes. There is no board.toml, because no default can know
# the wiring of a board, and without it the service does not start.
file(GLOB boards CONFIGURE_DEPENDS ${PROJECT_SOURCE_DIR}/firmware/io/config/examples/*.toml)
# etc below the prefix, unless CMAKE_INSTALL_SYSCONFDIR is absolute, as for the package.
install(FILES ${boards} DESTINATION ${CMAKE_INSTALL_SYSCONFDIR}/supercoil/boards)
