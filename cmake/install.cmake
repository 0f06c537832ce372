# What `cmake --install` lays down. Components: program, library, development.
#
# The modules become one shared library, so that whoever links it needs GLM's headers and nothing else of what Estampe is
# built with. What bakes is a second one, as only that needs Embree. The program keeps the modules in itself.
include(GNUInstallDirs)
include(CMakePackageConfigHelpers)

# estampe_shared(target NAME file EXPORT name OBJECTS modules... PUBLIC libraries... PRIVATE libraries...)
# What is PRIVATE brings the packages that the modules were built with; of their archives nothing is left to be taken.
function(estampe_shared target)
  cmake_parse_arguments(PARSE_ARGV 1 shared "" "NAME;EXPORT" "OBJECTS;PUBLIC;PRIVATE")
  list(TRANSFORM shared_OBJECTS REPLACE "(.+)" "$<TARGET_OBJECTS:\\1>")
  add_library(${target} SHARED ${shared_OBJECTS})
  set_target_properties(${target} PROPERTIES OUTPUT_NAME ${shared_NAME} EXPORT_NAME ${shared_EXPORT} LINKER_LANGUAGE CXX
    VERSION ${PROJECT_VERSION} SOVERSION ${PROJECT_VERSION_MAJOR}.${PROJECT_VERSION_MINOR}
    LINK_DEPENDS ${PROJECT_SOURCE_DIR}/cmake/exports.map)
  target_link_options(${target} PRIVATE -Wl,--version-script=${PROJECT_SOURCE_DIR}/cmake/exports.map -Wl,--as-needed)
  if(NOT ESTAMPE_SANITIZE) # whose own functions the program brings
    target_link_options(${target} PRIVATE -Wl,--no-undefined)
  else()
    target_link_options(${target} PRIVATE -fsanitize=${ESTAMPE_SANITIZE})
  endif()
  target_link_libraries(${target} PUBLIC ${shared_PUBLIC} PRIVATE ${shared_PRIVATE})
  install(TARGETS ${target} EXPORT estampe
    LIBRARY DESTINATION ${CMAKE_INSTALL_LIBDIR} COMPONENT library NAMELINK_COMPONENT development)
endfunction()

get_property(modules GLOBAL PROPERTY estampe_modules)
list(REMOVE_ITEM modules estampe_bake)
estampe_shared(estampe_shared NAME estampe EXPORT estampe OBJECTS ${modules} PUBLIC estampe_usage PRIVATE estampe_frame)
if(ESTAMPE_BAKE)
  estampe_shared(estampe_bake_shared NAME estampe_bake EXPORT bake OBJECTS estampe_bake estampe_baking
    PUBLIC estampe_shared PRIVATE estampe_bake)
endif()

install(TARGETS estampe_usage EXPORT estampe COMPONENT development)
install(DIRECTORY ${PROJECT_SOURCE_DIR}/include/estampe TYPE INCLUDE COMPONENT development)
set(config_folder ${CMAKE_INSTALL_LIBDIR}/cmake/estampe)
install(EXPORT estampe DESTINATION ${config_folder} FILE estampe-targets.cmake NAMESPACE estampe:: COMPONENT development)
configure_package_config_file(${CMAKE_CURRENT_LIST_DIR}/estampe-config.cmake.in ${PROJECT_BINARY_DIR}/estampe-config.cmake
  INSTALL_DESTINATION ${config_folder} NO_SET_AND_CHECK_MACRO)
write_basic_package_version_file(${PROJECT_BINARY_DIR}/estampe-config-version.cmake COMPATIBILITY SameMinorVersion)
install(FILES ${PROJECT_BINARY_DIR}/estampe-config.cmake ${PROJECT_BINARY_DIR}/estampe-config-version.cmake
  DESTINATION ${config_folder} COMPONENT development)
# pkg-config's paths follow the folder that the file lies in, so that the tree may be moved.
file(RELATIVE_PATH prefix_from_pc /${CMAKE_INSTALL_LIBDIR}/pkgconfig /)
configure_file(${CMAKE_CURRENT_LIST_DIR}/estampe.pc.in ${PROJECT_BINARY_DIR}/estampe.pc @ONLY)
install(FILES ${PROJECT_BINARY_DIR}/estampe.pc DESTINATION ${CMAKE_INSTALL_LIBDIR}/pkgconfig COMPONENT development)
