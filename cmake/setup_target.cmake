# perimorph_setup_target(<target>): flags, include folders and libraries of
# deal.II, then our own flags. To be called on every target with C++ sources, so
# that all of them can share one precompiled header.
function(perimorph_setup_target target)
  deal_ii_setup_target(${target})
  target_compile_options(${target} PRIVATE -Wall -Wextra)
  # deal.II 9.4 includes a header of Boost that prints a note without this.
  target_compile_definitions(${target} PRIVATE BOOST_BIND_GLOBAL_PLACEHOLDERS)
  if(CMAKE_BUILD_TYPE STREQUAL "Release")
    # deal.II asks for -g, which costs a third of the compile time
    target_compile_options(${target} PRIVATE -g0)
  endif()
  if(PERIMORPH_NATIVE)
    # g++ 12 takes the intrinsics of AVX-512 for uninitialised (GCC bug 105593):
    # thousands of lines for every use of Eigen. The debug preset still warns.
    target_compile_options(${target} PRIVATE
      -march=native -Wno-maybe-uninitialized)
  endif()

  # libgmsh carries its own copy of Eigen, compiled without -march=native, with
  # another alignment. Without this script the program would replace it by ours.
  get_target_property(type ${target} TYPE)
  if(type STREQUAL "EXECUTABLE")
    set(script ${PROJECT_SOURCE_DIR}/cmake/hide_eigen.map)
    target_link_options(${target} PRIVATE -Wl,--version-script=${script})
    set_property(TARGET ${target} APPEND PROPERTY LINK_DEPENDS ${script})
  endif()
endfunction()
