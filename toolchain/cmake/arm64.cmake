# Cross compilation for 64-bit ARM with Debian's packages: g++-aarch64-linux-gnu, and libraries of
# the architecture arm64 beside the host's own (dpkg --add-architecture arm64).
set(CMAKE_SYSTEM_NAME Linux)
set(CMAKE_SYSTEM_PROCESSOR aarch64)
set(CMAKE_LIBRARY_ARCHITECTURE aarch64-linux-gnu)

set(CMAKE_C_COMPILER aarch64-linux-gnu-gcc)
set(CMAKE_CXX_COMPILER aarch64-linux-gnu-g++)
# That GCC 10.1 passed some arguments otherwise is no news: all of it is compiled by one.
set(CMAKE_CXX_FLAGS_INIT -Wno-psabi)

# Debian keeps foreign libraries in /usr/lib/<triplet>, headers and header-only packages in /usr:
# there is no sysroot. What could be found wrongly is the host's own /usr/lib/<its triplet>.
set(CMAKE_FIND_ROOT_PATH_MODE_PROGRAM NEVER)
set(CMAKE_IGNORE_PREFIX_PATH /usr/local)
# pkg-config must know the libraries of arm64 only.
set(ENV{PKG_CONFIG_LIBDIR} /usr/lib/aarch64-linux-gnu/pkgconfig:/usr/share/pkgconfig)
