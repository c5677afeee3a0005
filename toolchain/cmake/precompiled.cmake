# Headers that most files include, parsed only once. clang-tidy and the debug preset find missing includes, because they
# do not use precompiled headers (CMAKE_DISABLE_PRECOMPILE_HEADERS).
file(CONFIGURE OUTPUT ${PROJECT_BINARY_DIR}/precompiled.cpp CONTENT "" @ONLY)
add_library(supercoil_precompiled OBJECT ${PROJECT_BINARY_DIR}/precompiled.cpp)
target_link_libraries(supercoil_precompiled PRIVATE supercoil_control supercoil_options)
target_precompile_headers(supercoil_precompiled PRIVATE
  <algorithm> <array> <atomic> <chrono> <cmath> <condition_variable> <filesystem> <fstream> <functional> <map> <memory>
  <mutex> <numeric> <optional> <random> <sstream> <string> <string_view> <thread> <tuple> <variant> <vector>
  <nlohmann/json.hpp> <tl/expected.hpp> <boost/lockfree/spsc_queue.hpp>
  <supercoil/control/estimation/estimator.hpp>
  <supercoil/control/thermal/interval_observer.hpp>
  <supercoil/control/thermal/rise_interval_observer.hpp>
  <supercoil/control/tracking/controller.hpp>)
if(SUPERCOIL_TESTS)
  target_precompile_headers(supercoil_precompiled PRIVATE <rapidcheck.h>)
endif()

# For every program and library that uses control in a folder and its subfolders.
function(supercoil_use_precompiled folder)
  get_property(targets DIRECTORY ${folder} PROPERTY BUILDSYSTEM_TARGETS)
  foreach(target IN LISTS targets)
    get_target_property(kind ${target} TYPE)
    if(kind MATCHES "EXECUTABLE|STATIC_LIBRARY" AND NOT target STREQUAL supercoil_plot)
      target_precompile_headers(${target} REUSE_FROM supercoil_precompiled)
    endif()
  endforeach()
  get_property(folders DIRECTORY ${folder} PROPERTY SUBDIRECTORIES)
  foreach(below IN LISTS folders)
    supercoil_use_precompiled(${below})
  endforeach()
endfunction()

set(folders firmware/io firmware/apps identification)
if(SUPERCOIL_SIMULATOR)
  list(APPEND folders host_sim)
endif()
if(SUPERCOIL_TESTS)
  foreach(tests unit/control unit/firmware unit/host_sim unit/identification loop can attack setup)
    list(APPEND folders tests/${tests})
  endforeach()
endif()
foreach(folder IN LISTS folders)
  supercoil_use_precompiled(${folder})
endforeach()
