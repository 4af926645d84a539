# SPDX-License-Identifier: GPL-3.0-or-later
# Warnings, sanitizers and the helpers every folder uses to declare its library, tool or test.
set(BREAST_WARNINGS -Wall -Wextra -Wpedantic -Wshadow=local -Wnon-virtual-dtor -Woverloaded-virtual
  # GCC 12's false positives in std::string; with precompiled headers it shows more of them
  -Wno-restrict -Wno-stringop-overflow -Wno-stringop-overread -Wno-array-bounds
  -Wno-maybe-uninitialized)  # and in GCC's AVX-512 headers under Eigen
if(BREAST_WERROR)
  list(APPEND BREAST_WARNINGS -Werror)
endif()
set(BREAST_SANITIZERS -fsanitize=address,undefined -fno-omit-frame-pointer)
if(BREAST_SANITIZE)
  add_link_options(-fsanitize=address,undefined)
endif()
# What a damaged file reaches first. A program whose readers alone are sanitized takes a tenth of the time of one that is
# sanitized throughout, so that thousands of damaged files can be tried. Such objects fit together with the others:
# no layout that files share is another (GCC pads no inline variables), and libstdc++ would mark the unused memory of its
# containers only with _GLIBCXX_SANITIZE_VECTOR, which is not defined.
set(BREAST_READER_FOLDERS core image surface mesh material cli command io export)
if(BREAST_SANITIZE STREQUAL "READERS")
  list(JOIN BREAST_READER_FOLDERS " " readers)
  file(WRITE ${CMAKE_RUNTIME_OUTPUT_DIRECTORY}/released-objects.txt
    "Sanitized: the main programs and libbreast's ${readers}. All other objects are of the release build.\n")
elseif(BREAST_SANITIZE)
  add_compile_options(${BREAST_SANITIZERS})
endif()
add_link_options(-Wl,--as-needed)
# Images, geometries and meshes have the same bytes on every x86-64 processor: what makes them is compiled
# for all of them, without fused multiply-add, and Eigen asks no processor for its caches or cores. Only
# these folders, which turn a mesh into numbers, use this machine's vector instructions.
option(BREAST_NATIVE "Use this machine's vector instructions in the mechanics" ON)
add_compile_options(-ffp-contract=off)
set(BREAST_NATIVE_FOLDERS material fem solve mechanics contact sensitivity projection matching)
set(BREAST_NATIVE_OPTIONS -march=native -ffp-contract=fast)
# Eigen's alignment must agree across all files, whatever their vectors.
add_compile_definitions(EIGEN_MAX_ALIGN_BYTES=64 EIGEN_MAX_STATIC_ALIGN_BYTES=64 EIGEN_NO_CPUID EIGEN_DONT_PARALLELIZE)
# ccache takes a precompiled header only when it is told not to mind macros and times inside it.
find_program(CCACHE_PROGRAM ccache)
if(CCACHE_PROGRAM)
  set(CMAKE_CXX_COMPILER_LAUNCHER env CCACHE_SLOPPINESS=pch_defines,time_macros ${CCACHE_PROGRAM})
  add_compile_options($<$<CXX_COMPILER_ID:GNU>:-fpch-preprocess>)
endif()

# breast_precompile(NAME HEADER... OPTIONS option... SYSTEM third-party...): these headers, read once for all
# targets that say breast_use_precompiled(TARGET NAME) and share the compiler's options but for -O1 to -O3.
function(breast_precompile name)
  cmake_parse_arguments(ARG "" "" "OPTIONS;SYSTEM" ${ARGN})
  set(target breast_precompiled_${name})
  add_library(${target} OBJECT ${PROJECT_SOURCE_DIR}/cmake/precompiled/empty.cpp)
  target_compile_options(${target} PRIVATE ${BREAST_WARNINGS} ${ARG_OPTIONS})
  target_link_libraries(${target} PRIVATE Eigen3::Eigen OpenMP::OpenMP_CXX ${ARG_SYSTEM})
  target_precompile_headers(${target} PRIVATE ${ARG_UNPARSED_ARGUMENTS})
endfunction()
function(breast_use_precompiled target name)
  target_precompile_headers(${target} REUSE_FROM breast_precompiled_${name})
endfunction()
set(BREAST_COMMON_HEADERS ${PROJECT_SOURCE_DIR}/cmake/precompiled/common.hpp)
breast_precompile(common ${BREAST_COMMON_HEADERS})
if(BREAST_NATIVE)
  breast_precompile(native ${BREAST_COMMON_HEADERS} OPTIONS ${BREAST_NATIVE_OPTIONS})
endif()

# The sanitizers for one target of BREAST_SANITIZE=READERS, without the precompiled header, which is compiled without them.
function(breast_sanitize_reader target)
  if(NOT BREAST_SANITIZE STREQUAL "READERS")
    return()
  endif()
  target_compile_options(${target} PRIVATE ${BREAST_SANITIZERS} -O1 -g1)
  set_target_properties(${target} PROPERTIES DISABLE_PRECOMPILE_HEADERS ON)
endfunction()

# Release builds of what no loop waits for: a third of the compiler's time for nothing anybody would notice.
function(breast_compile_quickly target)
  target_compile_options(${target} PRIVATE $<$<CONFIG:Release>:-O1>)
endfunction()

option(BREAST_UNITY "Compile the files of some libraries a dozen at a time: a build from nothing is shorter, one after a change longer")
# The dearest of those that a program takes as a whole. Of the others, as core and io, it takes a few files, and would
# link with the rest of a dozen what it does not need. Never those of BREAST_NATIVE_FOLDERS: which products are fused
# must not depend on what is compiled together.
set(BREAST_UNITY_LIBRARIES segment phantom)
# breast_library(NAME DEPENDS lib... SYSTEM third-party...): target breast_NAME from the .cpp files of this
# folder and of the folders in it. Third parties are PRIVATE: no header of ours shows them. COLD: none of its
# loops takes time.
function(breast_library name)
  cmake_parse_arguments(ARG "COLD" "" "SOURCES;DEPENDS;SYSTEM" ${ARGN})
  if(NOT ARG_SOURCES)
    file(GLOB ARG_SOURCES CONFIGURE_DEPENDS ${CMAKE_CURRENT_SOURCE_DIR}/*.cpp
      ${CMAKE_CURRENT_SOURCE_DIR}/*/*.cpp)
  endif()
  add_library(breast_${name} STATIC ${ARG_SOURCES})
  target_include_directories(breast_${name} PUBLIC ${PROJECT_SOURCE_DIR}/libbreast)
  target_compile_options(breast_${name} PRIVATE ${BREAST_WARNINGS})
  file(RELATIVE_PATH folder ${PROJECT_SOURCE_DIR}/libbreast ${CMAKE_CURRENT_SOURCE_DIR})
  string(REGEX REPLACE "/.*" "" folder "${folder}")
  if(BREAST_NATIVE AND folder IN_LIST BREAST_NATIVE_FOLDERS)
    target_compile_options(breast_${name} PRIVATE ${BREAST_NATIVE_OPTIONS})
    breast_use_precompiled(breast_${name} native)
  else()
    breast_use_precompiled(breast_${name} common)
    if(BREAST_UNITY AND name IN_LIST BREAST_UNITY_LIBRARIES)
      set_target_properties(breast_${name} PROPERTIES UNITY_BUILD ON UNITY_BUILD_BATCH_SIZE 12)
    endif()
  endif()
  list(TRANSFORM ARG_DEPENDS PREPEND breast_)
  target_link_libraries(breast_${name} PUBLIC ${ARG_DEPENDS} PRIVATE ${ARG_SYSTEM})
  if(ARG_COLD)
    breast_compile_quickly(breast_${name})
  endif()
  if(folder IN_LIST BREAST_READER_FOLDERS)
    breast_sanitize_reader(breast_${name})
  endif()
endfunction()

# In a function with ARG_DEPENDS: says in one line which library was left out, and leaves the function.
macro(breast_leave_out_without_its_libraries what)
  foreach(library ${ARG_DEPENDS})
    if(NOT TARGET breast_${library})
      message(STATUS "${what} is left out: libbreast/${library} is not built")
      return()
    endif()
  endforeach()
endmacro()

# breast_tool(NAME DEPENDS lib...): program NAME from NAME.cpp and, where there is one, NAME_options.cpp (a
# hyphen in NAME is written _ there), SOURCES that several tools share; left out, with one line, when a library it needs was left out.
function(breast_tool name)
  cmake_parse_arguments(ARG "" "" "DEPENDS;SYSTEM;SOURCES" ${ARGN})
  breast_leave_out_without_its_libraries("Tool ${name}")
  string(REPLACE "-" "_" options ${name}_options.cpp)
  file(GLOB options CONFIGURE_DEPENDS ${CMAKE_CURRENT_SOURCE_DIR}/${options})
  add_executable(${name} ${name}.cpp ${options} ${ARG_SOURCES})
  target_compile_options(${name} PRIVATE ${BREAST_WARNINGS})
  list(TRANSFORM ARG_DEPENDS PREPEND breast_)
  target_link_libraries(${name} PRIVATE breast_cli ${ARG_DEPENDS} ${ARG_SYSTEM})
  breast_use_precompiled(${name} common)
  breast_compile_quickly(${name})
  breast_sanitize_reader(${name})
  # All libraries are where the loader looks: what is installed is what was built.
  set_target_properties(${name} PROPERTIES SKIP_BUILD_RPATH ON)
  set_property(GLOBAL APPEND PROPERTY BREAST_TOOLS ${name})
endfunction()

# breast_bench(NAME DEPENDS lib...): program NAME from NAME.cpp that measures and is no tool; it may use the
# tests' fixtures. Left out, with one line, when a library it needs was left out.
function(breast_bench name)
  cmake_parse_arguments(ARG "" "" "DEPENDS;SYSTEM" ${ARGN})
  breast_leave_out_without_its_libraries("Program ${name}")
  add_executable(${name} ${name}.cpp)
  target_compile_options(${name} PRIVATE ${BREAST_WARNINGS})
  target_include_directories(${name} PRIVATE ${PROJECT_SOURCE_DIR}/tests)
  list(TRANSFORM ARG_DEPENDS PREPEND breast_)
  target_link_libraries(${name} PRIVATE ${ARG_DEPENDS} ${ARG_SYSTEM})
  breast_use_precompiled(${name} common)
endfunction()

# breast_test(LABEL SOURCE DEPENDS lib...): GoogleTest program LABEL_SOURCE; every TEST becomes a CTest
# with that label (unit, verify, extreme, tools). WHOLE: the program is one CTest, its tests share what is dear
# to prepare.
function(breast_test label source)
  cmake_parse_arguments(ARG "WHOLE" "TIMEOUT" "DEPENDS;SYSTEM" ${ARGN})
  breast_leave_out_without_its_libraries("Test ${label}/${source}")
  if(NOT ARG_TIMEOUT)
    set(ARG_TIMEOUT 120)
  endif()
  set(target ${label}_${source})
  add_executable(${target} ${CMAKE_CURRENT_SOURCE_DIR}/${source}.cpp)
  target_compile_options(${target} PRIVATE ${BREAST_WARNINGS})
  target_compile_definitions(${target} PRIVATE
    BREAST_BIN="${CMAKE_RUNTIME_OUTPUT_DIRECTORY}" BREAST_SOURCE="${PROJECT_SOURCE_DIR}")
  target_include_directories(${target} PRIVATE ${PROJECT_SOURCE_DIR}/tests)
  list(TRANSFORM ARG_DEPENDS PREPEND breast_)
  target_link_libraries(${target} PRIVATE ${ARG_DEPENDS} ${ARG_SYSTEM} GTest::gtest_main)
  breast_use_precompiled(${target} tests)
  breast_compile_quickly(${target})
  set_target_properties(${target} PROPERTIES RUNTIME_OUTPUT_DIRECTORY ${PROJECT_BINARY_DIR}/tests)
  if(ARG_WHOLE)
    add_test(NAME ${target} COMMAND ${target})
    # The longest begin first: a last one would run alone.
    set_tests_properties(${target} PROPERTIES LABELS ${label} TIMEOUT ${ARG_TIMEOUT} COST ${ARG_TIMEOUT}
      ENVIRONMENT GOMP_SPINCOUNT=1000)
    return()
  endif()
  gtest_discover_tests(${target} DISCOVERY_MODE PRE_TEST NO_PRETTY_VALUES
    # Without the setting a tool that a test runs inside itself would start the test program anew, which
    # then ends with exit 0 and nothing tested.
    PROPERTIES LABELS ${label} TIMEOUT ${ARG_TIMEOUT} ENVIRONMENT GOMP_SPINCOUNT=1000)
endfunction()
