# Half of a file's time to compile goes into reading std and Eigen. supercoil_firmware reads them once, for all targets
# that are named here; control, which is compiled without exceptions, is not among them. clang++ alone does: g++ 12 then
# reports errors of its own in std::string, and its builds without them find a missing #include.
set(supercoil_precompiled_headers
  <algorithm> <array> <atomic> <chrono> <cmath> <cstdio> <deque> <filesystem> <functional> <memory> <optional> <random>
  <sstream> <string> <thread> <variant> <vector>
  <Eigen/Core> <Eigen/LU> <tl/expected.hpp>)

function(supercoil_precompile target)
  if(CMAKE_CXX_COMPILER_ID STREQUAL "Clang")
    target_precompile_headers(${target} PRIVATE ${supercoil_precompiled_headers})
  endif()
endfunction()

# Headers that are compiled once need equal options: EIGEN_DONT_VECTORIZE too, where Eigen is not used.
function(supercoil_use_precompiled target)
  if(NOT CMAKE_CXX_COMPILER_ID STREQUAL "Clang")
    return()
  endif()
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
