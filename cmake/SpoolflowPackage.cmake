# What `cmake --install` puts where, and the Debian packages that `cpack` makes of it: the tool (component tool), the shared
# library for programs that run with it (runtime), what other programs build against (development), the add-ons' programs (live, fleet).
include(CMakePackageConfigHelpers)
set(CMAKE_INSTALL_DEFAULT_DIRECTORY_PERMISSIONS OWNER_READ OWNER_WRITE OWNER_EXECUTE GROUP_READ GROUP_EXECUTE WORLD_READ WORLD_EXECUTE) # whatever the umask

# Manual page and completion are made from the built command's own help; where it cannot run here, from that of this machine.
set(page_command $<TARGET_FILE:spoolflow>)
if(CMAKE_CROSSCOMPILING)
  set(page_command ${SPOOLFLOW_PLAIN_BUILD}/bin/spoolflow)
endif()
set(made ${PROJECT_BINARY_DIR}/package)
foreach(page IN ITEMS man_page:spoolflow.1 completion:spoolflow.bash)
  string(REGEX MATCH "^[^:]+" script ${page})
  string(REGEX REPLACE "^[^:]+:" "" file ${page})
  add_custom_command(
    OUTPUT ${made}/${file}
    COMMAND ${CMAKE_COMMAND} -E make_directory ${made}
    COMMAND ${PROJECT_SOURCE_DIR}/ci/${script}.sh ${page_command} > ${made}/${file}
    DEPENDS spoolflow_programs ${PROJECT_SOURCE_DIR}/ci/${script}.sh)
endforeach()
add_custom_command(OUTPUT ${made}/spoolflow.1.gz COMMAND gzip -9n < spoolflow.1 > spoolflow.1.gz DEPENDS ${made}/spoolflow.1
                   WORKING_DIRECTORY ${made})
add_custom_target(spoolflow_pages ALL DEPENDS ${made}/spoolflow.1.gz ${made}/spoolflow.bash)
# What the programs hold and need, as an SPDX list, where Debian's tools can say it.
find_program(SPOOLFLOW_DPKG_QUERY dpkg-query)
find_package(Python3 QUIET COMPONENTS Interpreter)
if(SPOOLFLOW_DPKG_QUERY AND Python3_EXECUTABLE AND NOT CMAKE_CROSSCOMPILING)
  add_custom_command(
    OUTPUT ${made}/spoolflow.spdx.json
    COMMAND ${Python3_EXECUTABLE} ${PROJECT_SOURCE_DIR}/ci/sbom.py -o ${made}/spoolflow.spdx.json "$<TARGET_FILE:spoolflow>"
            "$<$<TARGET_EXISTS:spoolflow_live>:$<TARGET_FILE:spoolflow_live>>"
            "$<$<TARGET_EXISTS:spoolflow_fleet>:$<TARGET_FILE:spoolflow_fleet>>"
    DEPENDS spoolflow_programs ${PROJECT_SOURCE_DIR}/ci/sbom.py ${PROJECT_SOURCE_DIR}/NOTICE
    COMMAND_EXPAND_LISTS)
  add_custom_target(spoolflow_sbom ALL DEPENDS ${made}/spoolflow.spdx.json)
  install(FILES ${made}/spoolflow.spdx.json DESTINATION ${CMAKE_INSTALL_DATADIR}/doc/spoolflow COMPONENT tool)
endif()
# All that is installed, for those who build no tests.
add_custom_target(installable DEPENDS spoolflow_programs spoolflow_pages spoolflow_c_shared spoolflow_c_static)
if(TARGET spoolflow_sbom)
  add_dependencies(installable spoolflow_sbom)
endif()
if(SPOOLFLOW_PYTHON_INTERPRETER)
  add_dependencies(installable addons_python_module)
endif()

# The tool.
install(TARGETS spoolflow RUNTIME COMPONENT tool)
install(FILES ${made}/spoolflow.1.gz DESTINATION ${CMAKE_INSTALL_MANDIR}/man1 COMPONENT tool)
install(FILES ${made}/spoolflow.bash DESTINATION ${CMAKE_INSTALL_DATADIR}/bash-completion/completions RENAME spoolflow
        COMPONENT tool)

# Libraries, headers, and how other builds find them. The sensor's core is headers only.
add_library(spoolflow_core INTERFACE)
target_include_directories(spoolflow_core INTERFACE $<INSTALL_INTERFACE:${CMAKE_INSTALL_INCLUDEDIR}>)
target_compile_features(spoolflow_core INTERFACE cxx_std_20)
set_target_properties(spoolflow_core PROPERTIES EXPORT_NAME sensor)
set_target_properties(spoolflow_c_shared PROPERTIES EXPORT_NAME spoolflow)
set_target_properties(spoolflow_c_static PROPERTIES EXPORT_NAME spoolflow_static)
install(TARGETS spoolflow_c_shared spoolflow_c_static spoolflow_core EXPORT spoolflow
        LIBRARY COMPONENT runtime NAMELINK_COMPONENT development
        ARCHIVE COMPONENT development)
install(FILES spoolflow/export/c_interface/spoolflow.h DESTINATION ${CMAKE_INSTALL_INCLUDEDIR} COMPONENT development)
install(DIRECTORY spoolflow/sensor DESTINATION ${CMAKE_INSTALL_INCLUDEDIR}/spoolflow COMPONENT development
        FILES_MATCHING PATTERN *.hpp)
install(DIRECTORY examples/c_interface DESTINATION ${CMAKE_INSTALL_DATADIR}/doc/libspoolflow-dev/examples COMPONENT development)
set(config ${CMAKE_INSTALL_LIBDIR}/cmake/spoolflow)
install(EXPORT spoolflow NAMESPACE spoolflow:: FILE spoolflowTargets.cmake DESTINATION ${config} COMPONENT development)
configure_package_config_file(cmake/spoolflowConfig.cmake.in ${made}/spoolflowConfig.cmake INSTALL_DESTINATION ${config})
write_basic_package_version_file(${made}/spoolflowConfigVersion.cmake COMPATIBILITY SameMajorVersion)
file(RELATIVE_PATH prefix_from_pkgconfig /${CMAKE_INSTALL_LIBDIR}/pkgconfig /)
configure_file(cmake/spoolflow.pc.in ${made}/spoolflow.pc @ONLY)
install(FILES ${made}/spoolflowConfig.cmake ${made}/spoolflowConfigVersion.cmake DESTINATION ${config} COMPONENT development)
install(FILES ${made}/spoolflow.pc DESTINATION ${CMAKE_INSTALL_LIBDIR}/pkgconfig COMPONENT development)

# The Python package, where it is built; in a prefix of its own PYTHONPATH names the folder.
set(packages tool:spoolflow runtime:libspoolflow${PROJECT_VERSION_MAJOR} development:libspoolflow-dev)
set(components tool runtime development)
foreach(program IN ITEMS live fleet)
  if(TARGET spoolflow_${program})
    install(TARGETS spoolflow_${program} RUNTIME COMPONENT ${program})
    list(APPEND packages ${program}:spoolflow-${program})
    list(APPEND components ${program})
  endif()
endforeach()
if(SPOOLFLOW_PYTHON_INTERPRETER)
  list(APPEND packages python:python3-spoolflow)
  list(APPEND components python)
  set(python lib/python3/dist-packages/spoolflow)
  install(TARGETS addons_python_module LIBRARY DESTINATION ${python} COMPONENT python)
  install(DIRECTORY addons/python/package/spoolflow/ DESTINATION ${python} COMPONENT python FILES_MATCHING PATTERN *.py PATTERN *.pyi PATTERN py.typed
          PATTERN __pycache__ EXCLUDE)
endif()

# The distributor of the packages is responsible for them.
set(SPOOLFLOW_PACKAGE_MAINTAINER "the spoolflow authors <spoolflow@example.org>" CACHE STRING
    "name and address that the Debian packages name as their maintainer's")

# Who may do what with it, and what has changed, of each package.
set(library libspoolflow${PROJECT_VERSION_MAJOR})
string(TIMESTAMP SPOOLFLOW_BUILD_DATE "%a, %d %b %Y %H:%M:%S +0000" UTC)
foreach(package IN LISTS packages)
  string(REGEX MATCH "^[^:]+" component ${package})
  string(REGEX REPLACE "^[^:]+:" "" SPOOLFLOW_PACKAGE ${package})
  configure_file(cmake/debian/changelog.in ${made}/${component}/changelog @ONLY)
  file(ARCHIVE_CREATE OUTPUT ${made}/${component}/changelog.gz PATHS ${made}/${component}/changelog FORMAT raw COMPRESSION GZip
       COMPRESSION_LEVEL 9)
  install(FILES ${PROJECT_SOURCE_DIR}/cmake/debian/copyright ${made}/${component}/changelog.gz
          DESTINATION ${CMAKE_INSTALL_DATADIR}/doc/${SPOOLFLOW_PACKAGE} COMPONENT ${component})
endforeach()

install(FILES CHANGELOG.md DESTINATION ${CMAKE_INSTALL_DATADIR}/doc/spoolflow COMPONENT tool)

# cpack -G DEB
set(CPACK_GENERATOR DEB)
set(CPACK_PACKAGE_NAME spoolflow)
set(CPACK_PACKAGE_VENDOR "the spoolflow authors")
set(CPACK_PACKAGE_CONTACT "${SPOOLFLOW_PACKAGE_MAINTAINER}")
set(CPACK_PACKAGING_INSTALL_PREFIX /usr)
set(CPACK_COMPONENTS_ALL ${components})
set(CPACK_DEB_COMPONENT_INSTALL ON)
set(CPACK_STRIP_FILES ON)
set(CPACK_DEBIAN_FILE_NAME DEB-DEFAULT)
set(CPACK_DEBIAN_PACKAGE_SHLIBDEPS ON)
set(CPACK_DEBIAN_PACKAGE_SECTION science)
set(CPACK_DEBIAN_PACKAGE_PRIORITY optional)
set(CPACK_DEBIAN_PACKAGE_GENERATE_SHLIBS ON)
set(CPACK_DEBIAN_RUNTIME_PACKAGE_NAME ${library})
set(CPACK_DEBIAN_RUNTIME_PACKAGE_SECTION libs)
set(CPACK_DEBIAN_RUNTIME_PACKAGE_CONTROL_EXTRA ${PROJECT_SOURCE_DIR}/cmake/debian/triggers)
set(CPACK_DEBIAN_DEVELOPMENT_PACKAGE_DEPENDS "${library} (= ${PROJECT_VERSION})")
set(CPACK_DEBIAN_TOOL_PACKAGE_NAME spoolflow)
set(CPACK_DEBIAN_DEVELOPMENT_PACKAGE_NAME libspoolflow-dev)
set(CPACK_DEBIAN_DEVELOPMENT_PACKAGE_SECTION libdevel)
set(CPACK_DEBIAN_PYTHON_PACKAGE_NAME python3-spoolflow)
set(CPACK_DEBIAN_PYTHON_PACKAGE_SECTION python)
if(SPOOLFLOW_PYTHON_INTERPRETER)
  math(EXPR next "${SPOOLFLOW_PYTHON_MINOR} + 1")
  set(CPACK_DEBIAN_PYTHON_PACKAGE_DEPENDS
      "python3 (>= 3.${SPOOLFLOW_PYTHON_MINOR}~), python3 (<< 3.${next}~), python3-numpy")  # the module is for this Python alone
  set(CPACK_DEBIAN_PYTHON_PACKAGE_SUGGESTS "python3-pandas, python3-matplotlib")
endif()
foreach(program IN ITEMS LIVE FLEET)
  string(TOLOWER ${program} name)
  set(CPACK_DEBIAN_${program}_PACKAGE_NAME spoolflow-${name})
  set(CPACK_DEBIAN_${program}_PACKAGE_DEPENDS "spoolflow (= ${PROJECT_VERSION})")
endforeach()
set(CPACK_DEBIAN_COMPRESSION_TYPE gzip)
set(CPACK_PRE_BUILD_SCRIPTS ${PROJECT_SOURCE_DIR}/cmake/debian/same_times.cmake)
include(CPack)
cpack_add_component(tool DESCRIPTION "Soft flow-rate sensor for spool valves: the command
 Calibrates a valve from bench recordings, estimates its flow rate from coil
 current, coil voltage and spool position, and exports the sensor as FMU or C++.")
cpack_add_component(runtime DESCRIPTION "Soft flow-rate sensor for spool valves: shared C library
 For programs that estimate the flow rate of a solenoid-operated spool valve
 from its coil current, coil voltage and spool position through spoolflow.h.")
cpack_add_component(development DESCRIPTION "Soft flow-rate sensor for spool valves: C library and C++ core
 spoolflow.h with shared and static library, the sensor's C++ headers, and the
 files by which CMake and pkg-config find them.")
if(TARGET spoolflow_live)
  cpack_add_component(live DESCRIPTION "Soft flow-rate sensor for spool valves: valves of one machine at work
 A page with flow rate, condition and alarms of valves at work, their history,
 messages, and outputs to fieldbus and plant: spoolflow live.")
endif()
if(TARGET spoolflow_fleet)
  cpack_add_component(fleet DESCRIPTION "Soft flow-rate sensor for spool valves: valves of many sites
 Workers that estimate and monitor the valves of many sites by NATS and
 PostgreSQL, and a page over all of them: spoolflow worker, spoolflow fleet.")
endif()
if(SPOOLFLOW_PYTHON_INTERPRETER)
  cpack_add_component(python DESCRIPTION "Soft flow-rate sensor for spool valves: Python package
 Recordings, models, flow rates and their judgement as arrays of NumPy and
 plain objects: import spoolflow.")
endif()
