# What every target of supercoil is compiled with. It stands beside control, which other projects add without the rest.
option(SUPERCOIL_WARNINGS_ARE_ERRORS "What the presets set" OFF)

# -O3, which is CMake's, takes a quarter longer to compile, and a simulation the same time; but for what a tick runs.
set(CMAKE_CXX_FLAGS_RELEASE "-O2 -DNDEBUG")
function(supercoil_runs_in_ticks target)
  target_compile_options(${target} PRIVATE $<$<CONFIG:Release>:-O3>)
  supercoil_only_computes(${target})
endfunction()
# Of what only computes a fuzz target hears which branches an input took, and not what each of them compared: what an input
# says is compared where it is read, and to tell of every comparison in every tick takes the tests long.
function(supercoil_only_computes target)
  target_compile_options(${target} PRIVATE $<$<BOOL:${SUPERCOIL_FUZZ}>:-fno-sanitize-coverage=trace-cmp,stack-depth>)
endfunction()

add_library(supercoil_options INTERFACE)
target_compile_options(supercoil_options INTERFACE
  -Wall -Wextra -Wconversion -Wshadow $<$<BOOL:${SUPERCOIL_WARNINGS_ARE_ERRORS}>:-Werror>
  # g++ 12 reports std::string's own operator+ (its bug 105651).
  $<$<CXX_COMPILER_ID:GNU>:-Wno-restrict>
  # Contracted multiply-adds would make arm64 and x86-64 differ in the last bit.
  -ffp-contract=off
  # So that the linker can leave out what a program does not use.
  $<$<CONFIG:Release>:-ffunction-sections>)
# Libraries' functions are found when a program starts: none is looked up in a tick.
target_link_options(supercoil_options INTERFACE -Wl,-z,now
  # What a program does not use of our libraries is left out: supercoild locks all of itself in memory.
  -Wl,--gc-sections)

if(SUPERCOIL_SANITIZE)
  # At -O0 the suite takes ten times as long; clang++'s -O1 hardly inlines, and its -O2 takes no longer to compile.
  # -g1: half of -g's time to compile, and names and lines remain.
  add_compile_options(-fsanitize=${SUPERCOIL_SANITIZE} -fno-sanitize-recover=all
                      -fno-omit-frame-pointer $<IF:$<CXX_COMPILER_ID:Clang>,-O2,-O1> -g1
                      $<$<CXX_COMPILER_ID:Clang>:-fsanitize-ignorelist=${CMAKE_CURRENT_LIST_DIR}/unsanitized.txt>
                      # g++ knows no fences under ThreadSanitizer; the only ones are in Asio, beside its mutexes.
                      $<$<CXX_COMPILER_ID:GNU>:-Wno-tsan>)
  if(SUPERCOIL_FUZZ)
    # Every branch counts itself, for libFuzzer to see what an input reached (tests/fuzz).
    add_compile_options(-fsanitize=fuzzer-no-link)
  endif()
  add_link_options(-fsanitize=${SUPERCOIL_SANITIZE})
endif()

# CLI11 takes 20 s to optimise, for what runs once.
function(supercoil_reads_command_line file)
  set(optimised -O1)
  if(SUPERCOIL_SANITIZE)
    set(optimised -O0)
  endif()
  set_source_files_properties(${file} PROPERTIES COMPILE_OPTIONS ${optimised} SKIP_PRECOMPILE_HEADERS ON)
endfunction()
