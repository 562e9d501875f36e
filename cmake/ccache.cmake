# Compile through ccache where it is installed. Precompiled headers need the
# sloppiness named here, else ccache never finds an earlier result.
if(PERIMORPH_CCACHE)
  find_program(PERIMORPH_CCACHE_PROGRAM ccache)
  mark_as_advanced(PERIMORPH_CCACHE_PROGRAM)
  if(PERIMORPH_CCACHE_PROGRAM)
    set(CMAKE_CXX_COMPILER_LAUNCHER
      ${CMAKE_COMMAND} -E env
      CCACHE_SLOPPINESS=pch_defines,time_macros
      ${PERIMORPH_CCACHE_PROGRAM})
  endif()
endif()
