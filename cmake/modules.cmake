# One folder, one target: estampe_module(scene DEPENDS core LINK PNG::PNG) makes the library estampe_scene from the
# sources beside the calling CMakeLists.txt, but for those after EXCEPT. Tests live beside the code: *_test.cpp needs no
# device, *_gpu_test.cpp does.

# What the public headers ask of whoever includes them.
add_library(estampe_usage INTERFACE)
target_compile_features(estampe_usage INTERFACE cxx_std_20)
target_compile_definitions(estampe_usage INTERFACE GLM_FORCE_DEPTH_ZERO_TO_ONE GLM_FORCE_XYZW_ONLY)
target_include_directories(estampe_usage INTERFACE $<BUILD_INTERFACE:${PROJECT_SOURCE_DIR}/include>
  $<INSTALL_INTERFACE:include>)
target_link_libraries(estampe_usage INTERFACE glm::glm)

# What Estampe's own sources are compiled with, and nobody else's.
add_library(estampe_flags INTERFACE)
target_link_libraries(estampe_flags INTERFACE estampe_usage)
target_compile_options(estampe_flags INTERFACE -Wall -Wextra -Wpedantic -Wconversion -Wshadow
  -Wno-missing-field-initializers) # designated initialisers leave the rest at their defaults on purpose
if(CMAKE_UNITY_BUILD) # which has no main file, in which alone a type with members from an anonymous namespace is right
  target_compile_options(estampe_flags INTERFACE $<$<CXX_COMPILER_ID:GNU>:-Wno-subobject-linkage>)
endif()
if(ESTAMPE_WERROR) # nobody's build stops at what a newer compiler has to say, some of which is false
  set(version ${CMAKE_CXX_COMPILER_VERSION})
  if((CMAKE_CXX_COMPILER_ID STREQUAL "GNU" AND version VERSION_GREATER_EQUAL 12 AND version VERSION_LESS 15) OR
     (CMAKE_CXX_COMPILER_ID STREQUAL "Clang" AND version VERSION_GREATER_EQUAL 14 AND version VERSION_LESS 15))
    target_compile_options(estampe_flags INTERFACE -Werror)
  else()
    message(STATUS "Warnings stay warnings: those of ${CMAKE_CXX_COMPILER_ID} ${version} are not known here")
  endif()
endif()
if(ESTAMPE_SANITIZE)
  # GCC's manual names false warnings about uninitialised variables as a limit of -fsanitize; <regex> has some.
  target_compile_options(estampe_flags INTERFACE -fsanitize=${ESTAMPE_SANITIZE} -fno-omit-frame-pointer
                         -Wno-maybe-uninitialized)
  target_link_options(estampe_flags INTERFACE -fsanitize=${ESTAMPE_SANITIZE})
endif()
target_include_directories(estampe_flags INTERFACE ${PROJECT_SOURCE_DIR}/src)

# What a shared library can be made of, see cmake/install.cmake; within it no function is replaced by another's.
function(estampe_shareable target)
  set_target_properties(${target} PROPERTIES POSITION_INDEPENDENT_CODE ON)
  target_compile_options(${target} PRIVATE -fno-semantic-interposition)
endfunction()

# Hands the test programs every *_test.cpp in and below the calling folder; *_gpu_test.cpp needs a device.
function(estampe_tests_beside)
  file(GLOB_RECURSE unit_tests CONFIGURE_DEPENDS ${CMAKE_CURRENT_SOURCE_DIR}/*_test.cpp)
  set(gpu_tests ${unit_tests})
  list(FILTER unit_tests EXCLUDE REGEX "_gpu_test\\.cpp$")
  list(FILTER gpu_tests INCLUDE REGEX "_gpu_test\\.cpp$")
  set_property(GLOBAL APPEND PROPERTY estampe_unit_tests ${unit_tests})
  set_property(GLOBAL APPEND PROPERTY estampe_gpu_tests ${gpu_tests})
endfunction()

function(estampe_module name)
  cmake_parse_arguments(PARSE_ARGV 1 module "" "" "DEPENDS;LINK;EXCEPT")
  file(GLOB_RECURSE sources CONFIGURE_DEPENDS ${CMAKE_CURRENT_SOURCE_DIR}/*.cpp)
  list(FILTER sources EXCLUDE REGEX "_test\\.cpp$")
  foreach(source ${module_EXCEPT})
    list(REMOVE_ITEM sources ${CMAKE_CURRENT_SOURCE_DIR}/${source})
  endforeach()
  add_library(estampe_${name} STATIC ${sources})
  estampe_shareable(estampe_${name})
  set_property(GLOBAL APPEND PROPERTY estampe_modules estampe_${name})
  target_link_libraries(estampe_${name} PRIVATE estampe_flags PUBLIC estampe_usage ${module_LINK})
  foreach(dependency ${module_DEPENDS})
    target_link_libraries(estampe_${name} PUBLIC estampe_${dependency})
  endforeach()
  estampe_tests_beside()
endfunction()
