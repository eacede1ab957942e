# One target a folder of spoolflow/, linked only as docs/ARCHITECTURE.md says, and one test program a folder of tests/.

set(CMAKE_CXX_STANDARD 20)
set(CMAKE_CXX_STANDARD_REQUIRED ON)
set(CMAKE_CXX_EXTENSIONS OFF)
set(CMAKE_POSITION_INDEPENDENT_CODE ON)
# -O3 is for what calculates (FAST): elsewhere it takes longer to compile and nothing less to run.
string(REPLACE "-O3" "-O2" CMAKE_CXX_FLAGS_RELEASE "${CMAKE_CXX_FLAGS_RELEASE}")
# ccache keeps nothing of what is compiled with such headers: ci/build.sh asks for them where there is none.
option(SPOOLFLOW_PRECOMPILED "Read the headers of the standard library and fmt once for all folders (GCC)" OFF)
if(NOT CMAKE_SYSTEM_PROCESSOR MATCHES "x86_64|AMD64")
  add_compile_options(-ffp-contract=off) # products and sums are rounded one by one, as they are there: the same answers everywhere
endif()

add_library(spoolflow_settings INTERFACE)
target_include_directories(spoolflow_settings INTERFACE $<BUILD_INTERFACE:${PROJECT_SOURCE_DIR}>)
target_compile_features(spoolflow_settings INTERFACE cxx_std_20)
add_library(spoolflow_warnings INTERFACE)
target_compile_options(spoolflow_warnings INTERFACE -Wall -Wextra -Wpedantic -Wshadow -Wconversion -Wno-sign-conversion
                                                    -Wnon-virtual-dtor -Woverloaded-virtual $<$<BOOL:${SPOOLFLOW_DEVELOPER}>:-Werror>)
if(SPOOLFLOW_SANITIZE)
  # Clang also finds names of other files that were joined to this one; GCC looks for shadows inside one.
  target_compile_options(spoolflow_warnings INTERFACE -Wno-shadow)
  add_compile_options(-fsanitize=address,undefined -fno-sanitize-recover=all -fno-omit-frame-pointer)
  add_link_options(-fsanitize=address,undefined)
  if(CMAKE_CXX_COMPILER_ID STREQUAL Clang)
    if(NOT SPOOLFLOW_FUZZ)
      add_compile_options(-fsanitize-ignorelist=${CMAKE_CURRENT_LIST_DIR}/sanitizers.ignore)
    endif()
    find_program(SPOOLFLOW_LLD NAMES ld.lld)
    if(SPOOLFLOW_LLD)
      add_link_options(-fuse-ld=lld)  # programs of 300 MB in a sixth of the time
    endif()
  endif()
endif()
if(SPOOLFLOW_FUZZ)
  add_compile_options(-fsanitize=fuzzer-no-link)
endif()

# Linux programs: addresses are random, tables of addresses are read-only once the program has started.
if(CMAKE_SYSTEM_NAME STREQUAL Linux AND NOT SPOOLFLOW_SANITIZE)
  include(CheckPIESupported)
  check_pie_supported()
  add_link_options(-Wl,-z,relro,-z,now)
endif()

# spoolflow_hardened(TARGET): a stack or a buffer that is overrun ends the program. For all but folders that calculate and see no
# byte of a file or of the network (the sensor and what steps it, calibration, the virtual rig), whose speed it would cost.
function(spoolflow_hardened target)
  if(CMAKE_SYSTEM_NAME STREQUAL Linux AND NOT SPOOLFLOW_SANITIZE AND NOT CMAKE_BUILD_TYPE STREQUAL Debug)
    target_compile_options(${target} PRIVATE -fstack-protector-strong -U_FORTIFY_SOURCE -D_FORTIFY_SOURCE=2)
  endif()
endfunction()

# spoolflow_link_names(LIST): in it the folder spoolflow/rig/plant becomes its target spoolflow_rig_plant, addons/live its addons_live.
function(spoolflow_link_names list)
  set(names "")
  foreach(link IN LISTS ${list})
    if(link MATCHES "^(spoolflow|addons)/")
      string(REPLACE "/" "_" link ${link})
    endif()
    list(APPEND names ${link})
  endforeach()
  set(${list} ${names} PARENT_SCOPE)
endfunction()

# spoolflow_light(TARGET): its time goes into texts, files and sockets; more than -O1 would but take longer to build.
function(spoolflow_light target)
  if(NOT SPOOLFLOW_SANITIZE)
    target_compile_options(${target} PRIVATE -O1)
  endif()
endfunction()

# spoolflow_fast(TARGET): its time goes into calculations.
function(spoolflow_fast target)
  if(NOT SPOOLFLOW_SANITIZE AND NOT CMAKE_BUILD_TYPE STREQUAL Debug)
    target_compile_options(${target} PRIVATE -O3)
  endif()
endfunction()

# spoolflow_precompiled(TARGET): headers of the standard library and of fmt, which take most files longer to read than their own
# lines to compile, are read once for all targets that are compiled with the same options; called when the target has its own.
function(spoolflow_precompiled target)
  if(NOT SPOOLFLOW_PRECOMPILED OR NOT CMAKE_CXX_COMPILER_ID STREQUAL GNU)
    return()
  endif()
  get_target_property(options ${target} COMPILE_OPTIONS)
  list(FILTER options INCLUDE REGEX "^-[OfUD]")
  string(MAKE_C_IDENTIFIER "spoolflow_headers${options}" headers)
  if(NOT TARGET ${headers})
    add_library(${headers} OBJECT ${PROJECT_SOURCE_DIR}/cmake/precompiled_headers/nothing.cpp)
    target_link_libraries(${headers} PRIVATE spoolflow_settings spoolflow_warnings fmt::fmt)
    set_target_properties(${headers} PROPERTIES COMPILE_OPTIONS "${options}")
    target_precompile_headers(${headers} PRIVATE ${PROJECT_SOURCE_DIR}/cmake/precompiled_headers/headers.hpp)
  endif()
  target_precompile_headers(${target} REUSE_FROM ${headers})
  target_compile_definitions(${target} PRIVATE $<TARGET_PROPERTY:fmt::fmt,INTERFACE_COMPILE_DEFINITIONS>)
endfunction()

# spoolflow_folder(NAME [LIGHT|FAST] [LINKS target…] [PRIVATE_LINKS target…] [APART file…])
# All *.cpp of the folder, but those that are compiled apart, become the library spoolflow_NAME, in addons/ addons_NAME; a folder
# without *.cpp is header-only. A part has its folder's name before its own: rig/plant becomes spoolflow_rig_plant. LIGHT and
# FAST: see spoolflow_light and spoolflow_fast.
function(spoolflow_folder name)
  cmake_parse_arguments(PARSE_ARGV 1 arg "LIGHT;FAST" "" "LINKS;PRIVATE_LINKS;APART")
  set(prefix spoolflow)
  if(CMAKE_CURRENT_SOURCE_DIR MATCHES "^${PROJECT_SOURCE_DIR}/addons/")
    set(prefix addons)
  endif()
  spoolflow_link_names(arg_LINKS)
  spoolflow_link_names(arg_PRIVATE_LINKS)
  string(REPLACE "/" "_" name ${name})
  file(GLOB sources CONFIGURE_DEPENDS ${CMAKE_CURRENT_SOURCE_DIR}/*.cpp)
  list(TRANSFORM arg_APART PREPEND ${CMAKE_CURRENT_SOURCE_DIR}/)
  if(arg_APART)
    list(REMOVE_ITEM sources ${arg_APART})
  endif()
  if(sources)
    add_library(${prefix}_${name} STATIC ${sources})
    target_link_libraries(${prefix}_${name} PUBLIC spoolflow_settings ${arg_LINKS} PRIVATE spoolflow_warnings ${arg_PRIVATE_LINKS})
    if(arg_LIGHT)
      spoolflow_light(${prefix}_${name})
    elseif(arg_FAST)
      spoolflow_fast(${prefix}_${name})
    endif()
    if(NOT name MATCHES "^(estimation|calibration_|rig|analysis|uncertainty|validation|plausibility|numerics|parallel|units)")
      spoolflow_hardened(${prefix}_${name})
    endif()
    spoolflow_precompiled(${prefix}_${name})
  else()
    add_library(${prefix}_${name} INTERFACE)
    target_link_libraries(${prefix}_${name} INTERFACE spoolflow_settings ${arg_LINKS})
  endif()
endfunction()

# spoolflow_tests(FOLDER [COMPUTES] [APART] [LINKS target…]): *_test.cpp of tests/FOLDER and its parts become one program, which
# ctest runs once: what several tests need (a campaign of the rig, a model) is made once. APART: each test is one of ctest's, in
# a process of its own. COMPUTES: the tests themselves compute with the headers of the sensor, and are optimised; others are not.
function(spoolflow_tests folder)
  cmake_parse_arguments(PARSE_ARGV 1 arg "COMPUTES;APART" "" "LINKS")
  spoolflow_link_names(arg_LINKS)
  file(GLOB_RECURSE sources CONFIGURE_DEPENDS ${CMAKE_CURRENT_SOURCE_DIR}/*_test.cpp)
  if(NOT sources)
    return()
  endif()
  add_executable(${folder}_test ${sources})
  target_link_libraries(${folder}_test PRIVATE spoolflow_warnings ${arg_LINKS} GTest::gtest GTest::gmock GTest::gtest_main)
  if(SPOOLFLOW_SANITIZE)
    return()  # ctest runs the whole program (spoolflow_sanitized_tests)
  endif()
  if(arg_COMPUTES)
    spoolflow_light(${folder}_test)  # what is tested is optimised in its own library
  else()
    target_compile_options(${folder}_test PRIVATE -O0)
  endif()
  if(arg_APART)
    gtest_discover_tests(${folder}_test TEST_PREFIX "${folder}." DISCOVERY_TIMEOUT 60 PROPERTIES LABELS unit TIMEOUT 300)
  else()
    add_test(NAME ${folder}.tests COMMAND ${folder}_test --gtest_brief=1)
    set_tests_properties(${folder}.tests PROPERTIES LABELS unit TIMEOUT 900 COST 300)
  endif()
endfunction()

# spoolflow_sanitized_tests(FOLDER [WITHOUT filter]): the same program of the build with sanitizers, the whole of it as one test,
# but for what takes minutes there (a filter of GoogleTest).
function(spoolflow_sanitized_tests folder)
  cmake_parse_arguments(PARSE_ARGV 1 arg "" "WITHOUT" "")
  if(NOT SPOOLFLOW_SANITIZED_BUILD OR NOT TARGET ${folder}_test)
    return()
  endif()
  get_target_property(place ${folder}_test BINARY_DIR)
  file(RELATIVE_PATH place ${PROJECT_BINARY_DIR} ${place})
  set(without "")
  if(arg_WITHOUT)
    set(without --gtest_filter=-${arg_WITHOUT})
  endif()
  add_test(NAME sanitizers.${folder} COMMAND ${SPOOLFLOW_SANITIZED_BUILD}/${place}/${folder}_test --gtest_brief=1 ${without})
  set_tests_properties(sanitizers.${folder} PROPERTIES TIMEOUT 900 COST 500)
endfunction()
