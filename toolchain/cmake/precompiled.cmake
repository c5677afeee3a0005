# Half of a file's time to compile goes into reading std and Eigen. supercoil_firmware reads them once, for all targets
# that are named here; control, which is compiled without exceptions, is not among them. The linter, the board's
# processor and Debian 13 compile without (CMAKE_DISABLE_PRECOMPILE_HEADERS), so that a missing #include is found.
set(supercoil_precompiled_headers
  <algorithm> <array> <atomic> <chrono> <cmath> <cstdio> <deque> <filesystem> <functional> <memory> <optional> <random>
  <sstream> <string> <thread> <variant> <vector>
  <Eigen/Core> <Eigen/LU> <tl/expected.hpp>)

# Headers that are compiled once need equal options: EIGEN_DONT_VECTORIZE too, where Eigen is not used.
function(supercoil_use_precompiled target)
  target_precompile_headers(${target} REUSE_FROM supercoil_firmware)
  target_compile_definitions(${target} PRIVATE EIGEN_DONT_VECTORIZE)
endfunction()

# CLI11 takes 20 s to optimise, for what runs once.
function(supercoil_reads_command_line file)
  set(optimised -O1)
  if(SUPERCOIL_SANITIZE)
    set(optimised -O0)
  endif()
  set_source_files_properties(${file} PROPERTIES COMPILE_OPTIONS ${optimised} SKIP_PRECOMPILE_HEADERS ON)
endfunction()
