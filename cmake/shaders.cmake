# estampe_shaders(hatch hatch.comp ...) compiles each shader with glslc and gives the target estampe_hatch a header
# "shaders/hatch_comp.hpp" with `estampe::shaders::hatch_comp`; folders are left out, so that no two shaders may have one
# file name, in whatever folders. GLSL may include from src/ ("shaders/noise.glsl").

find_program(GLSLC glslc REQUIRED)

function(estampe_shaders name)
  foreach(shader ${ARGN})
    get_filename_component(file ${shader} NAME)
    string(REPLACE "." "_" symbol ${file})
    set(source ${CMAKE_CURRENT_SOURCE_DIR}/${shader})
    get_property(namesake GLOBAL PROPERTY estampe_shader_${symbol})
    if(namesake)
      message(FATAL_ERROR "Two shaders are named ${file}, and would be one symbol: ${namesake} and ${source}")
    endif()
    set_property(GLOBAL PROPERTY estampe_shader_${symbol} ${source})
    set(words ${CMAKE_CURRENT_BINARY_DIR}/${symbol}.words)
    set(header ${CMAKE_CURRENT_BINARY_DIR}/shaders/${symbol}.hpp)
    add_custom_command(
      OUTPUT ${words}
      COMMAND ${GLSLC} --target-env=vulkan1.3 -O -Werror -I ${PROJECT_SOURCE_DIR}/src -mfmt=num -MD -MF ${words}.d -MT ${words}
              -o ${words} ${source}
      DEPENDS ${source}
      DEPFILE ${words}.d
      COMMENT "Compiling ${shader}")
    configure_file(${PROJECT_SOURCE_DIR}/cmake/shader.hpp.in ${header} @ONLY)
    target_sources(estampe_${name} PRIVATE ${words})
  endforeach()
  target_include_directories(estampe_${name} PRIVATE ${CMAKE_CURRENT_BINARY_DIR})
endfunction()

# estampe_shader_text(terrain mesh/terrain_vertices.comp DEFINITION) gives the target estampe_terrain a header
# "shaders/terrain_vertices_text.hpp" with `estampe::shaders::terrain_vertices_text`: the shader's GLSL with all that it
# includes, for programs that put a part of their own into it while they run.
function(estampe_shader_text name shader)
  get_filename_component(stem ${shader} NAME_WE)
  set(source ${CMAKE_CURRENT_SOURCE_DIR}/${shader})
  set(flat ${CMAKE_CURRENT_BINARY_DIR}/${stem}.flat)
  set(header ${CMAKE_CURRENT_BINARY_DIR}/shaders/${stem}_text.hpp)
  add_custom_command(
    OUTPUT ${header}
    COMMAND ${GLSLC} --target-env=vulkan1.3 -I ${PROJECT_SOURCE_DIR}/src -D${ARGV2} -E -MD -MF ${flat}.d -MT ${header}
            -o ${flat} ${source}
    COMMAND ${CMAKE_COMMAND} -D FLAT=${flat} -D SYMBOL=${stem}_text -D HEADER=${header}
            -P ${PROJECT_SOURCE_DIR}/cmake/shader_text.cmake
    DEPENDS ${source} ${PROJECT_SOURCE_DIR}/cmake/shader_text.cmake
    DEPFILE ${flat}.d
    COMMENT "Flattening ${shader}")
  target_sources(estampe_${name} PRIVATE ${header})
endfunction()
