# spoolflow_embed(TARGET NAMESPACE FUNCTION file…): the files' bytes become part of the target, so that the program needs
# no files beside it. The header spoolflow/…/FUNCTION.hpp declares, in NAMESPACE, `std::span<const EmbeddedFile> FUNCTION()`
# with EmbeddedFile{name, bytes}; the definition is made here. The assembler reads the files, not the compiler. A file is
# named without its folder; after RELATIVE FOLDER, by its path from there.
function(spoolflow_embed target namespace function)
  set(base "")
  if(ARGC GREATER 4 AND ARGV3 STREQUAL RELATIVE)
    set(base ${ARGV4})
    list(REMOVE_AT ARGN 0 1)
  endif()
  file(RELATIVE_PATH folder ${PROJECT_SOURCE_DIR} ${CMAKE_CURRENT_SOURCE_DIR})
  set(header ${folder}/${function}.hpp)
  set(blobs "")
  set(entries "")
  set(paths "")
  foreach(file IN LISTS ARGN)
    list(LENGTH paths index)
    get_filename_component(path ${file} ABSOLUTE)
    if(base)
      file(RELATIVE_PATH leaf ${base} ${path})
    else()
      get_filename_component(leaf ${file} NAME)
    endif()
    set(symbol ${function}_${index})
    string(APPEND blobs [[__asm__(".section .rodata\n.balign 16\n]] "${symbol}:" [[\n.incbin \"]] "${path}" [[\"\n]]
           "${symbol}_end:" [[\n.byte 0\n.previous\n");]] "\n"
           "extern const char ${symbol}[] __asm__(\"${symbol}\");\n"
           "extern const char ${symbol}_end[] __asm__(\"${symbol}_end\");\n")
    string(APPEND entries "      {\"${leaf}\", {${symbol}, static_cast<std::size_t>(${symbol}_end - ${symbol})}},\n")
    list(APPEND paths ${path})
  endforeach()
  set(source ${CMAKE_CURRENT_BINARY_DIR}/${function}.cpp)
  configure_file(${PROJECT_SOURCE_DIR}/cmake/embedded_files.cpp.in ${source} @ONLY)
  if(NOT TARGET ${target})  # a group, which the folder above makes (spoolflow_joined)
    set_source_files_properties(${source} DIRECTORY ${CMAKE_CURRENT_SOURCE_DIR}/..
                                PROPERTIES OBJECT_DEPENDS "${paths}" SKIP_UNITY_BUILD_INCLUSION ON)
    set_property(GLOBAL APPEND PROPERTY ${target}_sources ${source})
  else()
    set_source_files_properties(${source} PROPERTIES OBJECT_DEPENDS "${paths}" SKIP_UNITY_BUILD_INCLUSION ON)
    target_sources(${target} PRIVATE ${source})
  endif()
endfunction()
