# One target a folder of spoolflow/, linked only as docs/ARCHITECTURE.md says, and one test program a folder of tests/.

set(CMAKE_CXX_STANDARD 20)
set(CMAKE_CXX_STANDARD_REQUIRED ON)
set(CMAKE_CXX_EXTENSIONS OFF)
set(CMAKE_POSITION_INDEPENDENT_CODE ON)

add_library(spoolflow_settings INTERFACE)
target_include_directories(spoolflow_settings INTERFACE $<BUILD_INTERFACE:${PROJECT_SOURCE_DIR}>)
target_compile_features(spoolflow_settings INTERFACE cxx_std_20)
add_library(spoolflow_warnings INTERFACE)
target_compile_options(spoolflow_warnings INTERFACE -Wall -Wextra -Wpedantic -Wshadow -Wconversion -Wno-sign-conversion
                                                    -Wnon-virtual-dtor -Woverloaded-virtual -Werror)
if(SPOOLFLOW_SANITIZE)
  # Clang also finds names of other files that were joined to this one; GCC looks for shadows inside one.
  target_compile_options(spoolflow_warnings INTERFACE -Wno-shadow)
  add_compile_options(-fsanitize=address,undefined -fno-sanitize-recover=all -fno-omit-frame-pointer)
  add_link_options(-fsanitize=address,undefined)
endif()

# spoolflow_folder(NAME [LINKS target…] [PRIVATE_LINKS target…] [APART file…])
# All *.cpp of the folder, but those that are compiled apart, become the library spoolflow_NAME; a folder without *.cpp is
# header-only.
function(spoolflow_folder name)
  cmake_parse_arguments(PARSE_ARGV 1 arg "" "" "LINKS;PRIVATE_LINKS;APART")
  list(TRANSFORM arg_LINKS REPLACE "^spoolflow/" "spoolflow_")
  list(TRANSFORM arg_PRIVATE_LINKS REPLACE "^spoolflow/" "spoolflow_")
  file(GLOB sources CONFIGURE_DEPENDS ${CMAKE_CURRENT_SOURCE_DIR}/*.cpp)
  list(TRANSFORM arg_APART PREPEND ${CMAKE_CURRENT_SOURCE_DIR}/)
  if(arg_APART)
    list(REMOVE_ITEM sources ${arg_APART})
  endif()
  if(sources)
    add_library(spoolflow_${name} STATIC ${sources})
    target_link_libraries(spoolflow_${name} PUBLIC spoolflow_settings ${arg_LINKS} PRIVATE spoolflow_warnings ${arg_PRIVATE_LINKS})
  else()
    add_library(spoolflow_${name} INTERFACE)
    target_link_libraries(spoolflow_${name} INTERFACE spoolflow_settings ${arg_LINKS})
  endif()
endfunction()

# spoolflow_tests(FOLDER [LINKS target…]): tests/FOLDER/*_test.cpp become one program, its tests found by ctest.
function(spoolflow_tests folder)
  cmake_parse_arguments(PARSE_ARGV 1 arg "" "" "LINKS")
  list(TRANSFORM arg_LINKS REPLACE "^spoolflow/" "spoolflow_")
  file(GLOB sources CONFIGURE_DEPENDS ${CMAKE_CURRENT_SOURCE_DIR}/*_test.cpp)
  if(NOT sources)
    return()
  endif()
  add_executable(${folder}_test ${sources})
  target_link_libraries(${folder}_test PRIVATE spoolflow_warnings ${arg_LINKS} GTest::gtest GTest::gmock GTest::gtest_main)
  if(NOT SPOOLFLOW_SANITIZE)
    target_compile_options(${folder}_test PRIVATE -O1)  # what is tested is optimised in its own library; this builds sooner
  endif()
  if(SPOOLFLOW_SANITIZE)
    return()  # ctest runs the whole program (tests/CMakeLists.txt)
  endif()
  gtest_discover_tests(${folder}_test TEST_PREFIX "${folder}." DISCOVERY_TIMEOUT 60 PROPERTIES LABELS unit TIMEOUT 300)
endfunction()
