# Compiler settings shared by every target, and the two helpers the folders use.

set(CMAKE_CXX_STANDARD 20)
set(CMAKE_CXX_STANDARD_REQUIRED ON)
set(CMAKE_CXX_EXTENSIONS OFF)
set(CMAKE_EXPORT_COMPILE_COMMANDS ON)

find_package(Eigen3 3.4 REQUIRED NO_MODULE)
if(EMSCRIPTEN)
  add_library(OpenMP::OpenMP_CXX INTERFACE IMPORTED)  # one thread (src/core/parallel.cpp)
elseif(NOT MIMICX_BARE)
  find_package(OpenMP REQUIRED COMPONENTS CXX)
endif()

# What whoever compiles our headers needs, too: C++20, the instruction set, Eigen's settings. Every room's target carries
# it; our warnings it does not (MIMICX_OWN_OPTIONS).
add_library(mimicx_settings INTERFACE)
target_compile_features(mimicx_settings INTERFACE cxx_std_20)
target_include_directories(mimicx_settings INTERFACE $<BUILD_INTERFACE:${PROJECT_SOURCE_DIR}/src>
  $<INSTALL_INTERFACE:include> $<INSTALL_INTERFACE:include/mimicx>)
if(NOT PROJECT_IS_TOP_LEVEL)  # <mimicx/physics/step.h>, as installed
  file(MAKE_DIRECTORY ${PROJECT_BINARY_DIR}/include)
  file(CREATE_LINK ${PROJECT_SOURCE_DIR}/src ${PROJECT_BINARY_DIR}/include/mimicx SYMBOLIC)
  target_include_directories(mimicx_settings INTERFACE $<BUILD_INTERFACE:${PROJECT_BINARY_DIR}/include>)
endif()
target_link_libraries(mimicx_settings INTERFACE Eigen3::Eigen)

# Of our own code alone.
# -Wno-psabi: packs wider than a target's registers pass between functions of one build alone.
set(MIMICX_OWN_OPTIONS -Wall -Wextra -Wconversion -Werror -Wno-psabi)
if(CMAKE_CXX_COMPILER_ID STREQUAL "GNU")
  # GCC 12 reports Eigen's vectorised temporaries as maybe uninitialised, and copies inside its own strings as out of
  # bounds (its bug 105329); the other analyses stay on.
  list(APPEND MIMICX_OWN_OPTIONS -Wno-maybe-uninitialized -Wno-array-bounds -Wno-restrict -Wno-stringop-overflow)
  if(NOT MIMICX_FOR_CLANG_TIDY)  # it collects no garbage before it has taken 1 GB: a tenth of the time
    list(APPEND MIMICX_OWN_OPTIONS "SHELL:--param ggc-min-heapsize=1048576")
  endif()
  if(MIMICX_TARGET STREQUAL "x86-64-v4")
    # Its AVX-512 intrinsics spell "undefined" as a variable initialised by itself.
    list(APPEND MIMICX_OWN_OPTIONS -Wno-uninitialized)
  endif()
endif()

# The shared library holds the rooms, and shows nothing of them (docs/library.md). Hidden functions are inlined as without
# -fPIC.
if(NOT MIMICX_BARE AND NOT EMSCRIPTEN)
  list(APPEND MIMICX_OWN_OPTIONS -fPIC -fvisibility=hidden)
endif()

if(MIMICX_FUZZ)
  # The libraries, too: what libFuzzer does not see covered it cannot look for.
  set(MIMICX_FUZZ_OPTIONS -fsanitize=fuzzer-no-link,address,undefined,float-cast-overflow -fno-sanitize-recover=all)
  target_compile_options(mimicx_settings INTERFACE ${MIMICX_FUZZ_OPTIONS})
  target_link_options(mimicx_settings INTERFACE ${MIMICX_FUZZ_OPTIONS})
endif()

# Bits depend on these: no contraction behind our back (fused operations are written out), no
# fast-math, one fixed instruction set instead of -march=native.
target_compile_options(mimicx_settings INTERFACE -Wno-psabi -ffp-contract=off -fno-math-errno)
if(MIMICX_TARGET STREQUAL "x86-64-v3")
  target_compile_options(mimicx_settings INTERFACE -march=x86-64-v3)
elseif(MIMICX_TARGET STREQUAL "x86-64-v4")
  target_compile_options(mimicx_settings INTERFACE -march=x86-64-v4 -mprefer-vector-width=512)
elseif(EMSCRIPTEN)
  target_compile_options(mimicx_settings INTERFACE -msimd128 -fwasm-exceptions)
  target_link_options(mimicx_settings INTERFACE -fwasm-exceptions)
elseif(NOT MIMICX_TARGET STREQUAL "portable")
  message(FATAL_ERROR "MIMICX_TARGET is '${MIMICX_TARGET}': expected x86-64-v3, x86-64-v4 or portable")
endif()
# Portable arithmetic: no fused operations (src/physics/pack.h), and Eigen adds up in the order of its plain loops. It
# cuts products into blocks by the number of registers, too, which it would guess from the processor.
if(MIMICX_ARITHMETIC STREQUAL "portable" OR MIMICX_TARGET STREQUAL "portable")
  target_compile_definitions(mimicx_settings INTERFACE
    MIMICX_PORTABLE_ARITHMETIC EIGEN_DONT_VECTORIZE EIGEN_ARCH_DEFAULT_NUMBER_OF_REGISTERS=16)
  # Where GCC 12 packs scalars into vectors it leaves out roundings to float and back: the plan of tools/portable_hash
  # came out otherwise for x86-64-v3.
  if(CMAKE_CXX_COMPILER_ID STREQUAL "GNU" AND NOT MIMICX_FOR_CLANG_TIDY)
    target_compile_options(mimicx_settings INTERFACE -fno-tree-slp-vectorize)
  endif()
elseif(NOT MIMICX_ARITHMETIC STREQUAL "native")
  message(FATAL_ERROR "MIMICX_ARITHMETIC is '${MIMICX_ARITHMETIC}': expected native or portable")
endif()
if(MIMICX_BARE)
  target_compile_options(mimicx_settings INTERFACE -fno-exceptions -fno-rtti)
  target_compile_definitions(mimicx_settings INTERFACE MIMICX_BARE)
endif()
# Eigen must start no threads of its own. Nor may it ask the processor for its caches: it would cut products
# into blocks by them, and the order in which a product is summed depends on the blocks. These sizes are what
# it takes instead (32 KiB, 512 KiB, 8 MiB).
target_compile_definitions(mimicx_settings INTERFACE
  EIGEN_DONT_PARALLELIZE EIGEN_NO_CPUID EIGEN_DEFAULT_L1_CACHE_SIZE=32768
  EIGEN_DEFAULT_L2_CACHE_SIZE=524288 EIGEN_DEFAULT_L3_CACHE_SIZE=8388608
  MIMICX_TARGET="${MIMICX_TARGET}" MIMICX_VERSION="${PROJECT_VERSION}")

# What takes a run's time is optimised as far as it goes, all else as far as it compiles quickly: -O3 and -O1, in a page,
# which is loaded as a whole, -O3 and -Os. Never both in one command for a page: after an -Os em++ inlines no functions.
# Tests are compiled with -Og, in three quarters of the time of -O1.
# The hot rooms keep -O3 for their bits in native arithmetic, too: with all of them at -O1 taught policies came out
# otherwise (GCC 12 leaves out roundings where it packs scalars into vectors: src/control/CMakeLists.txt).
set(MIMICX_HOT_ROOMS character control core fit motion nn physics render rl rl_tracking skin teaching)
set(CMAKE_CXX_FLAGS_RELEASE "")

# A room is compiled in a few pieces of several files each ("unity" files): the headers, Eigen's above all, are read
# once per piece. Names are therefore unique in a room, file-local ones, too (tools/check_layers). Every file still
# includes what it needs: tools/check --full runs clang-tidy on each alone. Hot code is compiled in smaller pieces.
option(MIMICX_UNITY "Compile several files of a room as one" ON)

# Headers that nearly every piece reads are parsed once for each way of compiling. Precompiled headers bring their options
# along, the level of optimisation, too: files with options of their own do without.
set(MIMICX_COMMON_HEADERS <Eigen/Core> <Eigen/Geometry> <algorithm> <array> <filesystem> <functional> <map>
  <memory> <optional> <set> <span> <stdexcept> <string> <vector> <core/so3.h> <character/character.h> <motion/clip.h>)
file(CONFIGURE OUTPUT ${PROJECT_BINARY_DIR}/common_headers.cpp CONTENT "// Compiles the common headers.\n")

# MuJoCo is an optional second engine for tests and benchmarks (Debian: libmujoco-dev).
if(MIMICX_WITH_MUJOCO AND NOT MIMICX_CORE_ONLY AND NOT MIMICX_BARE)
  find_path(MUJOCO_INCLUDE mujoco/mujoco.h)
  find_library(MUJOCO_LIBRARY mujoco)
  if(MUJOCO_INCLUDE AND MUJOCO_LIBRARY)
    add_library(mimicx_mujoco INTERFACE)
    target_include_directories(mimicx_mujoco SYSTEM INTERFACE ${MUJOCO_INCLUDE})
    target_link_libraries(mimicx_mujoco INTERFACE ${MUJOCO_LIBRARY})
  else()
    message(STATUS "MuJoCo not found: what compares with it is left out")
  endif()
endif()

# mimicx_compile(TARGET LEVEL): as "hot" or "cold" code of the program, or as that of a "test": how far it is optimised, how
# many files are one piece, and which headers are precompiled.
function(mimicx_compile target level)
  set(optimise $<IF:$<BOOL:${EMSCRIPTEN}>,-Os,-O1>)
  set(files 12)
  set(headers ${MIMICX_COMMON_HEADERS})
  if(level STREQUAL "hot")
    set(optimise -O3)
    set(files 5)
  elseif(level STREQUAL "test")
    set(optimise -Og)
    list(APPEND headers <gtest/gtest.h>)
  endif()
  target_compile_options(${target} PRIVATE $<$<CONFIG:Release>:${optimise}> ${MIMICX_OWN_OPTIONS})
  if(MIMICX_FOR_CLANG_TIDY)
    set(files 0)  # a room is one piece: two fifths of the time
  endif()
  if(MIMICX_UNITY)
    set_target_properties(${target} PROPERTIES UNITY_BUILD ON UNITY_BUILD_BATCH_SIZE ${files})
  endif()
  if(MIMICX_BARE)
    return()
  endif()
  if(NOT TARGET mimicx_${level}_headers)
    add_library(mimicx_${level}_headers OBJECT ${PROJECT_BINARY_DIR}/common_headers.cpp)
    target_link_libraries(mimicx_${level}_headers PRIVATE mimicx_settings OpenMP::OpenMP_CXX
      $<$<STREQUAL:${level},test>:GTest::gtest_main>)
    target_compile_options(mimicx_${level}_headers PRIVATE $<$<CONFIG:Release>:${optimise}> ${MIMICX_OWN_OPTIONS})
    target_precompile_headers(mimicx_${level}_headers PRIVATE ${headers})
  endif()
  target_precompile_headers(${target} REUSE_FROM mimicx_${level}_headers)
endfunction()

# mimicx_sources(OUT [FOLDERS FOLDERS...] [EXCEPT FILES...]): the .cpp files of the current folder and of these in it.
function(mimicx_sources out)
  cmake_parse_arguments(ARG "" "" "FOLDERS;EXCEPT" ${ARGN})
  list(TRANSFORM ARG_FOLDERS APPEND "/*.cpp")
  file(GLOB sources RELATIVE ${CMAKE_CURRENT_SOURCE_DIR} CONFIGURE_DEPENDS *.cpp ${ARG_FOLDERS})
  list(REMOVE_ITEM sources ${ARG_EXCEPT})
  set(${out} ${sources} PARENT_SCOPE)
endfunction()

# mimicx_library(NAME [FOLDERS...] [EXCEPT...] [DEPENDS LIBS...]): a room, one static library; mimicx::NAME for others.
function(mimicx_library name)
  cmake_parse_arguments(ARG "" "" "FOLDERS;EXCEPT;DEPENDS" ${ARGN})
  mimicx_sources(sources FOLDERS ${ARG_FOLDERS} EXCEPT ${ARG_EXCEPT})
  add_library(mimicx_${name} STATIC ${sources})
  add_library(mimicx::${name} ALIAS mimicx_${name})
  set_target_properties(mimicx_${name} PROPERTIES EXPORT_NAME ${name})
  set_property(GLOBAL APPEND PROPERTY MIMICX_ROOMS mimicx_${name})
  target_link_libraries(mimicx_${name} PUBLIC mimicx_settings ${ARG_DEPENDS})
  if(name IN_LIST MIMICX_HOT_ROOMS)
    mimicx_compile(mimicx_${name} hot)
  else()
    mimicx_compile(mimicx_${name} cold)
  endif()
endfunction()

# These start first, else the last of them would run alone for half a minute.
set(MIMICX_LONGEST_SUITES Cli Adapt Plan Fit ShippedOptions AddNoise Synthesize Pretrain PlanMotions)

# mimicx_add_suites(TARGET): one test of ctest per suite of the program: the tests of a suite share what they have made,
# synthetic motions above all.
function(mimicx_add_suites target)
  get_target_property(sources ${target} SOURCES)
  set(suites)
  foreach(source ${sources})
    set_property(DIRECTORY APPEND PROPERTY CMAKE_CONFIGURE_DEPENDS ${source})
    file(STRINGS ${source} lines REGEX "^(TYPED_)?TEST(_F|_P)?\\(")
    foreach(line ${lines})
      string(REGEX REPLACE "^[A-Z_]+\\(([A-Za-z0-9]+).*" "\\1" suite "${line}")
      list(APPEND suites ${suite})
    endforeach()
  endforeach()
  list(REMOVE_DUPLICATES suites)
  foreach(suite ${suites})
    add_test(NAME ${suite} COMMAND ${target} --gtest_filter=${suite}.*:*/${suite}.*:${suite}/*)
    if(suite IN_LIST MIMICX_LONGEST_SUITES)
      set_tests_properties(${suite} PROPERTIES COST 10)
    endif()
  endforeach()
endfunction()

# mimicx_rooms_of(OUT TARGETS...): these static libraries and all that they link.
function(mimicx_rooms_of out)
  set(rooms)
  foreach(target ${ARGN})
    get_target_property(links ${target} INTERFACE_LINK_LIBRARIES)
    list(FILTER links INCLUDE REGEX "^mimicx_")
    list(REMOVE_ITEM links mimicx_settings mimicx_mujoco)
    mimicx_rooms_of(more ${links})
    list(APPEND rooms ${target} ${more})
  endforeach()
  list(REMOVE_DUPLICATES rooms)
  set(${out} ${rooms} PARENT_SCOPE)
endfunction()

# mimicx_test(NAME [FOLDERS...] [EXCEPT...] DEPENDS LIBS...): one GoogleTest program per room under test.
function(mimicx_test name)
  cmake_parse_arguments(ARG "" "" "FOLDERS;EXCEPT;DEPENDS" ${ARGN})
  mimicx_sources(sources FOLDERS ${ARG_FOLDERS} EXCEPT ${ARG_EXCEPT})
  add_executable(test_${name} ${sources})
  target_include_directories(test_${name} PRIVATE ${PROJECT_SOURCE_DIR}/tests)
  target_link_libraries(test_${name} PRIVATE ${ARG_DEPENDS} GTest::gtest_main)
  # Of an inline function the linker takes the first copy: that of the rooms, which are compiled for speed. Tests would
  # take a tenth longer with their own.
  mimicx_rooms_of(rooms ${ARG_DEPENDS})
  list(TRANSFORM rooms REPLACE ".+" "$<TARGET_FILE:\\0>")
  target_link_options(test_${name} PRIVATE LINKER:--whole-archive ${rooms} LINKER:--no-whole-archive)
  target_compile_definitions(test_${name} PRIVATE
    MIMICX_SOURCE_DIR="${PROJECT_SOURCE_DIR}" MIMICX_SHARED_DIR="${PROJECT_SOURCE_DIR}/../shared")
  mimicx_compile(test_${name} test)
  cmake_language(EVAL CODE "cmake_language(DEFER CALL mimicx_add_suites test_${name})")  # when it has all its sources
endfunction()
