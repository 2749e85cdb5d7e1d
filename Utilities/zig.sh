# SPDX-License-Identifier: GPL-3.0-or-later
# Sourced: compiles for other systems with PyPI's ziglang, a clang that has the C and C++ libraries of
# other systems. Uses $folder, and oneTBB where $onetbb has its source; both are exported.

# prepare_zig INCLUDE: finds Boost, CGAL and Eigen in a folder. Only headers, because those of this system's
# C library do not fit other systems. Sets libcxx, the folder of zig's C++ library.
prepare_zig()
{
  [[ -d $folder/zig ]] || python3 -m venv "$folder/zig"
  # Other versions have other C++ libraries and linkers than those that were tried.
  "$folder/zig/bin/python" -m pip install --quiet ziglang==0.17.1
  mkdir -p "$folder/headers" "$folder/shims/sys"
  libcxx=$(echo "$folder"/zig/lib/python3.*/site-packages/ziglang/lib/libcxx)
  ln -sfn "$1"/{boost,CGAL} "$1/eigen3/Eigen" "$folder/headers"
  # CGAL includes this header, which glibc has since 2.32, wherever it exists. This one is found before zig's.
  echo 'static const char __libc_single_threaded = 0;' > "$folder/shims/sys/single_threaded.h"
  # What the C++ library declares but does not define is visible despite the compiler's option.
  cat > "$folder/shims/hidden.h" << END
#include <__config>
#undef _LIBCPP_NAMESPACE_VISIBILITY
#define _LIBCPP_NAMESPACE_VISIBILITY __attribute__((visibility("hidden")))
END
}

zig()
{
  ZIG_GLOBAL_CACHE_DIR=$folder/cache ZIG_LOCAL_CACHE_DIR=$folder/cache "$folder/zig/bin/python" -m ziglang "$@"
}

# Sets core_sources, with those that CMake makes, and library_sources.
find_sources()
{
  local layouts layout
  mkdir -p "$folder/sources"
  read -ra layouts < <(sed -nE 's/^foreach \(TSample IN ITEMS (.*)\)$/\1/p' Core/CMakeLists.txt)
  for layout in "${layouts[@]}"; do
    sed "s/@TSample@/$layout/" Core/ExtractFromCloud.cxx.in > "$folder/sources/ExtractFrom$layout.cxx"
  done
  mapfile -t core_sources < <(find "$folder/sources" Core -name '*.cxx')
  mapfile -t library_sources < <(find Library -name '*.cxx')
}

# The object of a source for a target.
object_of()
{
  echo "$folder/$1/${2//\//+}.o"
}

# compile TARGET SOURCE: into $folder/TARGET.
compile()
{
  local object options=(-O3 -g0 -std=c++17 -fPIC -fvisibility=hidden -fvisibility-inlines-hidden
    -ffile-prefix-map="$folder/"= -I"$folder/shims" -isystem "$folder/headers")
  object=$(object_of "$1" "$2")
  # Otherwise macOS may replace weak symbols of the C++ library by those of its own one.
  [[ $1 != *-macos* ]] || options+=(-D_LIBCPP_DISABLE_VISIBILITY_ANNOTATIONS -include "$folder/shims/hidden.h"
    -fvisibility-global-new-delete=force-hidden)
  if [[ -n $onetbb ]]; then
    # The names that its header of exports defines: nothing of it is exported.
    options+=(-D__TBB_detail__export_H -DTBB_EXPORT= -DTBBMALLOC_EXPORT= -D__TBB_NO_IMPLICIT_LINKAGE=1
      -D__TBBMALLOC_NO_IMPLICIT_LINKAGE=1 -isystem "$onetbb/include")
  fi
  case $2 in
    */libcxx/src/*) options+=(-std=c++23 -D_LIBCPP_BUILDING_LIBRARY -DLIBCXX_BUILDING_LIBCXXABI -I"${2%/*}" -w) ;;
    */src/tbb/*)
      options+=(-D__TBB_BUILD -D__TBB_USE_ITT_NOTIFY=0 -D__TBB_DYNAMIC_LOAD_ENABLED=0 -I"$onetbb/src" -w)
      case $1 in
        *-windows-*) options+=(-D_WIN32_WINNT=0x0A00 -DUSE_WINTHREAD) ;; # main.cpp has DllMain
        *)
          # One class is visible on macOS whatever the compiler's option says.
          options+=(-DUSE_PTHREAD -D_XOPEN_SOURCE=600 -D_DARWIN_C_SOURCE -D__TBB_SOURCE_DIRECTLY_INCLUDED=1
            -UTBB_EXPORT '-DTBB_EXPORT=__attribute__((visibility("hidden")))')
          ;;
      esac
      # These look for the instruction before they use it.
      [[ $1/$2 != x86_64-*/@(arena|task_dispatcher).cpp ]] || options+=(-mwaitpkg)
      ;;
    *)
      # Those of CMake/CompileOptions.cmake and Core/CMakeLists.txt.
      options+=(-ffp-contract=off -fno-math-errno -I. -DCGAL_DISABLE_GMP=1 -DCGAL_DISABLE_MPFR=1
        -DCGAL_HEADER_ONLY=1 -DBOOST_NO_CXX98_FUNCTION_BASE -DNOMINMAX)
      [[ -z $onetbb ]] || options+=(-DCGAL_LINKED_WITH_TBB)
      [[ $2 != Core/Tetrahedra/* ]] || options+=(-frounding-math -DBOOST_DISABLE_EXPLICIT_SYMBOL_VISIBILITY)
      [[ $2 != Library/* ]] || options+=(-DISOPOINT_BUILDS_LIBRARY)
      [[ $2 != Testing/* && $2 != */googletest/* ]] ||
        options+=(-ILibrary -I"$folder/googletest" -isystem "$folder/googletest/include")
      ;;
  esac
  rm -f "$object" # of a former run
  zig c++ -target "$1" -c "${options[@]}" "$2" -o "$object" > "$object.log" 2>&1 ||
    echo "$1: $2 fails: $object.log" >&2
}
export -f zig object_of compile

# compile_all TARGET SOURCE...: several at a time. Those that fail are named and lack an object.
compile_all()
{
  local target=$1
  shift
  mkdir -p "$folder/$target"
  printf '%s\n' "$@" | xargs -P "$(nproc)" -I SOURCE bash -O extglob -c 'compile "$@"' _ "$target" SOURCE
}

# link TARGET OUTPUT OPTION... -- SOURCE...: links the objects of sources.
link()
{
  local target=$1 output=$2 options=() source objects=()
  shift 2
  while [[ $1 != -- ]]; do
    options+=("$1")
    shift
  done
  shift
  for source in "$@"; do
    objects+=("$(object_of "$target" "$source")")
  done
  zig c++ -target "$target" "${options[@]}" "${objects[@]}" -o "$output"
}
