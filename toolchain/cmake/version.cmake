# The version that --version, pages, summaries, recordings and packages give for this build.
set(SUPERCOIL_VERSION "" CACHE STRING "Empty: by toolchain/version, which asks git")
set(supercoil_version ${SUPERCOIL_VERSION})
if(NOT supercoil_version)
  execute_process(COMMAND ${PROJECT_SOURCE_DIR}/toolchain/version OUTPUT_VARIABLE supercoil_version
                  OUTPUT_STRIP_TRAILING_WHITESPACE COMMAND_ERROR_IS_FATAL ANY)
  # Configures again after each commit, which changes the version.
  if(EXISTS ${PROJECT_SOURCE_DIR}/.git/logs/HEAD)
    set_property(DIRECTORY APPEND PROPERTY CMAKE_CONFIGURE_DEPENDS ${PROJECT_SOURCE_DIR}/.git/logs/HEAD)
  endif()
endif()
