# Cross compilation for 64-bit ARM with Debian's packages: g++-aarch64-linux-gnu, and libraries of
# the architecture arm64 in addition to the host's own (dpkg --add-architecture arm64).
set(CMAKE_SYSTEM_NAME Linux)
set(CMAKE_SYSTEM_PROCESSOR aarch64)
set(CMAKE_LIBRARY_ARCHITECTURE aarch64-linux-gnu)

set(CMAKE_C_COMPILER aarch64-linux-gnu-gcc)
set(CMAKE_CXX_COMPILER aarch64-linux-gnu-g++)
# GCC 10.1 changed how some arguments are passed; this does not matter with a single compiler.
set(CMAKE_CXX_FLAGS_INIT -Wno-psabi)

# Debian keeps foreign libraries in /usr/lib/<triplet>, headers and header-only packages in /usr:
# there is no sysroot. Only the host's own /usr/lib/<its triplet> could be found by mistake.
set(CMAKE_FIND_ROOT_PATH_MODE_PROGRAM NEVER)
set(CMAKE_IGNORE_PREFIX_PATH /usr/local)
# pkg-config must know only the libraries of arm64.
set(ENV{PKG_CONFIG_LIBDIR} /usr/lib/aarch64-linux-gnu/pkgconfig:/usr/share/pkgconfig)
