# For supercoil-sim as packages have it: g++ optimises it for what supercoil-profile-runs does, and across files. Two
# configurations of one build folder (toolchain/profile-guided): generate, with which supercoil-profile-runs counts how
# often each branch is taken, and then use. The results are the same to the bit.
set(SUPERCOIL_PROFILE "" CACHE STRING "Profile-guided optimisation by g++: generate or use")
set_property(CACHE SUPERCOIL_PROFILE PROPERTY STRINGS "" generate use)
if(SUPERCOIL_PROFILE AND NOT CMAKE_CXX_COMPILER_ID STREQUAL GNU)
  message(FATAL_ERROR "SUPERCOIL_PROFILE needs g++, not ${CMAKE_CXX_COMPILER_ID}")
endif()
if(SUPERCOIL_PROFILE STREQUAL generate)
  add_compile_options(-fprofile-generate -fprofile-update=single)
  add_link_options(-fprofile-generate)
elseif(SUPERCOIL_PROFILE STREQUAL use)
  # Of all that was counted, 99.9 % is optimised for speed: g++'s 99 % leave out what few scenarios need in every tick.
  # With counts and across files, g++ 12 warns of sound code in Boost and the standard library; the ordinary build,
  # whose warnings are errors, checks ours.
  add_compile_options(-fprofile-use --param=hot-bb-count-ws-permille=999 -w)
  add_link_options(-w)
  set(CMAKE_INTERPROCEDURAL_OPTIMIZATION ON)
elseif(SUPERCOIL_PROFILE)
  message(FATAL_ERROR "SUPERCOIL_PROFILE is \"${SUPERCOIL_PROFILE}\": must be generate, use or empty")
endif()
