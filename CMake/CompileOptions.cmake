# The options below that the compiler supports: SCATTEREDISOPOINTS_COMPILE_OPTIONS for all sources, and
# SCATTEREDISOPOINTS_CGAL_OPTIONS for those that include CGAL.
include(CheckCXXCompilerFlag)

# known_options(variable option...)
function (known_options variable)
  set(known)
  foreach (option IN LISTS ARGN)
    string(MAKE_C_IDENTIFIER "SCATTEREDISOPOINTS_HAS${option}" has_option)
    check_cxx_compiler_flag("${option}" ${has_option})
    if (${has_option})
      list(APPEND known "${option}")
    endif ()
  endforeach ()
  set(${variable} ${known} PARENT_SCOPE)
endfunction ()

# Results are defined to the last bit: no compiler may fuse a multiplication into an addition.
# Nothing reads errno after math functions: without it, square roots are vectorized.
# CGAL's predicates change the rounding mode; its own CMake files tell only GCC.
if (MSVC)
  set(arithmetic /fp:strict /fp:except- /bigobj)
  set(warnings /W3)
  set(stop_at_warning /WX)
  set(rounding)
else ()
  set(arithmetic -ffp-contract=off -fno-math-errno)
  set(warnings -Wall -Wextra)
  set(stop_at_warning -Werror)
  set(rounding -frounding-math)
endif ()
if (NOT SCATTEREDISOPOINTS_WARNINGS_AS_ERRORS)
  set(stop_at_warning)
endif ()
known_options(SCATTEREDISOPOINTS_COMPILE_OPTIONS ${arithmetic} ${warnings} ${stop_at_warning})
known_options(SCATTEREDISOPOINTS_CGAL_OPTIONS ${rounding})
