# Compile options of every supercoil target. In control's folder, because other projects add control without the rest.
option(SUPERCOIL_WARNINGS_ARE_ERRORS "Treat warnings as errors; on in the presets" OFF)

# -O3, CMake's default, takes a quarter longer to compile and makes simulations no faster: only for code that ticks run.
set(CMAKE_CXX_FLAGS_RELEASE "-O2 -DNDEBUG")
function(supercoil_runs_in_ticks target)
  target_compile_options(${target} PRIVATE $<$<CONFIG:Release>:-O3>)
  supercoil_only_computes(${target})
endfunction()
# For code that only computes: fuzz targets record the branches that an input took, but no comparisons. The parsers
# compare inputs, and recording every comparison of every tick slows the tests down.
function(supercoil_only_computes target)
  target_compile_options(${target} PRIVATE $<$<BOOL:${SUPERCOIL_FUZZ}>:-fno-sanitize-coverage=trace-cmp,stack-depth>)
endfunction()

add_library(supercoil_options INTERFACE)
target_compile_options(supercoil_options INTERFACE
  -Wall -Wextra -Wconversion -Wshadow $<$<BOOL:${SUPERCOIL_WARNINGS_ARE_ERRORS}>:-Werror>
  # g++ 12 warns about std::string's own operator+ (GCC bug 105651).
  $<$<CXX_COMPILER_ID:GNU>:-Wno-restrict>
  # Contracted multiply-adds would make arm64 and x86-64 differ in the last bit.
  -ffp-contract=off
  # So that the linker can drop functions that a program does not use.
  $<$<CONFIG:Release>:-ffunction-sections>)
# Resolves shared libraries' functions when a program starts, not at the first call, which may be in a tick.
target_link_options(supercoil_options INTERFACE -Wl,-z,now
  # Drops unused functions of our libraries: supercoild locks its whole image in memory.
  -Wl,--gc-sections)

if(SUPERCOIL_SANITIZE)
  # At -O0 the suite takes ten times as long. clang++'s -O1 hardly inlines, and its -O2 takes no longer to compile.
  # -g1 compiles in half the time of -g, and keeps names and line numbers.
  add_compile_options(-fsanitize=${SUPERCOIL_SANITIZE} -fno-sanitize-recover=all
                      -fno-omit-frame-pointer $<IF:$<CXX_COMPILER_ID:Clang>,-O2,-O1> -g1
                      $<$<CXX_COMPILER_ID:Clang>:-fsanitize-ignorelist=${CMAKE_CURRENT_LIST_DIR}/unsanitized.txt>
                      # g++'s ThreadSanitizer does not model fences; the only ones are in Asio, beside its mutexes.
                      $<$<CXX_COMPILER_ID:GNU>:-Wno-tsan>)
  if(SUPERCOIL_FUZZ)
    # Counts every branch, so that libFuzzer sees which code an input reached (tests/fuzz).
    add_compile_options(-fsanitize=fuzzer-no-link)
  endif()
  add_link_options(-fsanitize=${SUPERCOIL_SANITIZE})
endif()

# CLI11 takes 20 s to optimise, for code that runs once.
function(supercoil_reads_command_line file)
  set(optimised -O1)
  if(SUPERCOIL_SANITIZE)
    set(optimised -O0)
  endif()
  set_source_files_properties(${file} PROPERTIES COMPILE_OPTIONS ${optimised} SKIP_PRECOMPILE_HEADERS ON)
endfunction()
