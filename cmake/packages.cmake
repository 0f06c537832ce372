# The program with its manual page, completion and place on a desktop, and Debian packages of all: cmake --preset package,
# then cpack, see script/package. estampe has the program, libestampeX.Y what other programs are linked to, libestampe-dev
# what they are built with, and python3-estampe, with ESTAMPE_PYTHON, the Python module.
install(TARGETS estampe RUNTIME COMPONENT program)
set(desktop ${CMAKE_CURRENT_LIST_DIR}/desktop)

# The program tells of itself, so that a new command is in both.
find_program(GZIP gzip REQUIRED)
set(told ${PROJECT_BINARY_DIR}/told)
add_custom_command(OUTPUT ${told}/estampe.1.gz ${told}/estampe
  COMMAND ${CMAKE_COMMAND} -E make_directory ${told}
  COMMAND estampe --man > ${told}/estampe.1
  COMMAND ${GZIP} -9nf ${told}/estampe.1
  COMMAND estampe --completion > ${told}/estampe
  DEPENDS estampe
  VERBATIM)
add_custom_target(estampe_manual ALL DEPENDS ${told}/estampe.1.gz ${told}/estampe)
install(FILES ${told}/estampe.1.gz DESTINATION ${CMAKE_INSTALL_MANDIR}/man1 COMPONENT program)
install(FILES ${told}/estampe DESTINATION ${CMAKE_INSTALL_DATADIR}/bash-completion/completions COMPONENT program)
install(FILES ${desktop}/estampe.xml DESTINATION ${CMAKE_INSTALL_DATADIR}/mime/packages COMPONENT program)
install(FILES ${desktop}/estampe.svg DESTINATION ${CMAKE_INSTALL_DATADIR}/icons/hicolor/scalable/apps COMPONENT program)
install(FILES ${desktop}/estampe.desktop DESTINATION ${CMAKE_INSTALL_DATADIR}/applications COMPONENT program)

set(library_package libestampe${PROJECT_VERSION_MAJOR}.${PROJECT_VERSION_MINOR})
add_custom_command(OUTPUT ${told}/changelog.Debian.gz
  COMMAND ${GZIP} -9nc ${desktop}/changelog > ${told}/changelog.Debian.gz
  DEPENDS ${desktop}/changelog
  VERBATIM)
add_custom_target(estampe_changelog ALL DEPENDS ${told}/changelog.Debian.gz)
set(components_of_packages program=estampe library=${library_package} development=libestampe-dev)
if(ESTAMPE_PYTHON)
  list(APPEND components_of_packages python=python3-estampe)
endif()
set(CPACK_COMPONENTS_ALL)
foreach(component_of ${components_of_packages})
  string(REGEX MATCH "(.+)=(.+)" _ ${component_of})
  set(component ${CMAKE_MATCH_1})
  set(package ${CMAKE_MATCH_2})
  install(FILES ${PROJECT_SOURCE_DIR}/LICENSE DESTINATION ${CMAKE_INSTALL_DATADIR}/doc/${package} RENAME copyright
    COMPONENT ${component})
  install(FILES ${told}/changelog.Debian.gz DESTINATION ${CMAKE_INSTALL_DATADIR}/doc/${package} COMPONENT ${component})
  string(TOUPPER ${component} upper)
  set(CPACK_DEBIAN_${upper}_PACKAGE_NAME ${package})
  list(APPEND CPACK_COMPONENTS_ALL ${component})
endforeach()

set(CPACK_GENERATOR DEB)
set(CPACK_DEB_COMPONENT_INSTALL ON)
set(CPACK_PACKAGING_INSTALL_PREFIX /usr)
set(CPACK_STRIP_FILES ON)
set(CPACK_INSTALL_DEFAULT_DIRECTORY_PERMISSIONS
  OWNER_READ OWNER_WRITE OWNER_EXECUTE GROUP_READ GROUP_EXECUTE WORLD_READ WORLD_EXECUTE)
set(CPACK_PACKAGE_CONTACT "The authors of Estampe <estampe@localhost>")
set(CPACK_DEBIAN_FILE_NAME DEB-DEFAULT)
set(CPACK_DEBIAN_PACKAGE_RELEASE 1)
set(CPACK_DEBIAN_PACKAGE_SHLIBDEPS ON)
set(CPACK_DEBIAN_PACKAGE_SHLIBDEPS_PRIVATE_DIRS ${PROJECT_BINARY_DIR})
set(CPACK_DEBIAN_PACKAGE_GENERATE_SHLIBS ON)

set(CPACK_PACKAGE_DESCRIPTION_SUMMARY "draws 3D scenes as a hand would")
set(CPACK_COMPONENT_PROGRAM_DESCRIPTION
"The program. It reads glTF, OBJ, PLY, STL, FBX and DAE scenes and draws them
as pen, ink and paper: hatching that carries the tone, contours, a wash of
colour. It writes pictures, layers, strokes and films, and draws on devices
of Vulkan 1.3, or on the processor by Mesa's lavapipe.")
set(CPACK_DEBIAN_PROGRAM_PACKAGE_SECTION graphics)
# What is opened at run time, where dpkg-shlibdeps does not see it.
set(CPACK_DEBIAN_PROGRAM_PACKAGE_DEPENDS libvulkan1)
set(CPACK_DEBIAN_PROGRAM_PACKAGE_RECOMMENDS "mesa-vulkan-drivers | vulkan-icd, ffmpeg, glslc")

set(CPACK_COMPONENT_LIBRARY_DESCRIPTION
"The shared libraries that programs which draw with Estampe are linked to.")
set(CPACK_DEBIAN_LIBRARY_PACKAGE_SECTION libs)
set(CPACK_DEBIAN_LIBRARY_PACKAGE_DEPENDS libvulkan1)
set(CPACK_DEBIAN_LIBRARY_PACKAGE_RECOMMENDS "mesa-vulkan-drivers | vulkan-icd, ffmpeg, glslc")

set(CPACK_COMPONENT_DEVELOPMENT_DESCRIPTION
"Headers, and what CMake and pkg-config find the libraries by.")
set(CPACK_DEBIAN_DEVELOPMENT_PACKAGE_SECTION libdevel)
set(CPACK_DEBIAN_DEVELOPMENT_PACKAGE_DEPENDS "${library_package} (= ${PROJECT_VERSION}-${CPACK_DEBIAN_PACKAGE_RELEASE}), libglm-dev")
set(CPACK_DEBIAN_DEVELOPMENT_PACKAGE_SUGGESTS libvulkan-dev) # for estampe/vulkan.hpp
set(CPACK_DEBIAN_DEVELOPMENT_PACKAGE_SHLIBDEPS OFF)

if(ESTAMPE_PYTHON)
  # The extension fits one minor version of Python, and the library that it was built with.
  string(REGEX MATCH "^3\\.([0-9]+)" python_version ${Python3_VERSION})
  math(EXPR next_minor "${CMAKE_MATCH_1} + 1")
  set(CPACK_COMPONENT_PYTHON_DESCRIPTION
"The Python module estampe. It draws scene files and numpy arrays, and returns
pictures, layers and strokes as numpy arrays.")
  set(CPACK_DEBIAN_PYTHON_PACKAGE_SECTION python)
  string(CONCAT CPACK_DEBIAN_PYTHON_PACKAGE_DEPENDS
    "${library_package} (= ${PROJECT_VERSION}-${CPACK_DEBIAN_PACKAGE_RELEASE}), "
    "python3 (>= ${python_version}~), python3 (<< 3.${next_minor}), python3-numpy")
endif()
include(CPack)
