# estampe_shaders(hatch hatch.comp ...) compiles each shader with glslc and gives the target estampe_hatch a header
# "shaders/hatch_comp.hpp" with `estampe::shaders::hatch_comp`; folders are left out, so that no two shaders may have one
# file name, in whatever folders. GLSL may include from src/ ("shaders/noise.glsl").

find_program(GLSLC glslc REQUIRED)
set(glslc_warnings "")
if(ESTAMPE_WERROR)
  set(glslc_warnings -Werror)
endif()

# Compiles `source` with the macros that follow `file`, which names the result as if the shader were a file of that name.
function(estampe_compile_shader name source file)
  string(REPLACE "." "_" symbol ${file})
  get_property(namesake GLOBAL PROPERTY estampe_shader_${symbol})
  if(namesake)
    message(FATAL_ERROR "Two shaders are named ${file}, and would be one symbol: ${namesake} and ${source}")
  endif()
  set_property(GLOBAL PROPERTY estampe_shader_${symbol} ${source})
  set(words ${CMAKE_CURRENT_BINARY_DIR}/${symbol}.words)
  set(header ${CMAKE_CURRENT_BINARY_DIR}/shaders/${symbol}.hpp)
  list(TRANSFORM ARGN PREPEND -D OUTPUT_VARIABLE defines)
  add_custom_command(
    OUTPUT ${words}
    COMMAND ${GLSLC} --target-env=vulkan1.3 -O ${glslc_warnings} -I ${PROJECT_SOURCE_DIR}/src ${defines} -mfmt=num
            -MD -MF ${words}.d -MT ${words} -o ${words} ${source}
    DEPENDS ${source}
    DEPFILE ${words}.d
    COMMENT "Compiling ${file}")
  configure_file(${PROJECT_SOURCE_DIR}/cmake/shader.hpp.in ${header} @ONLY)
  target_sources(estampe_${name} PRIVATE ${words})
endfunction()

function(estampe_shaders name)
  foreach(shader ${ARGN})
    get_filename_component(file ${shader} NAME)
    estampe_compile_shader(${name} ${CMAKE_CURRENT_SOURCE_DIR}/${shader} ${file})
  endforeach()
  target_include_directories(estampe_${name} PRIVATE ${CMAKE_CURRENT_BINARY_DIR})
endfunction()

# estampe_shader_variants(raster compute/bin.comp
#   VARIANT bin_ids
#   VARIANT bin_depth RASTER_DEPTH_ONLY)
# compiles one source several times. Each variant has a name and the macros that are defined in it (NAME or NAME=VALUE).
# Each becomes a shader as if it were a file of that name: "shaders/bin_ids_comp.hpp" with
# `estampe::shaders::bin_ids_comp`. The source by itself is none.
function(estampe_shader_variants name shader)
  set(variant "")
  foreach(word ${ARGN})
    if(word STREQUAL VARIANT)
      estampe_shader_variant(${name} ${shader} ${variant})
      set(variant "")
    else()
      list(APPEND variant ${word})
    endif()
  endforeach()
  estampe_shader_variant(${name} ${shader} ${variant})
  target_include_directories(estampe_${name} PRIVATE ${CMAKE_CURRENT_BINARY_DIR})
endfunction()

# Compiles one variant of a source: its name, then its macros. Does nothing without a name, as before the first VARIANT.
function(estampe_shader_variant name shader)
  set(macros ${ARGN})
  list(POP_FRONT macros variant)
  if(NOT variant)
    return()
  endif()
  set(source ${CMAKE_CURRENT_SOURCE_DIR}/${shader})
  get_filename_component(stage ${shader} LAST_EXT)
  estampe_compile_shader(${name} ${source} ${variant}${stage} ${macros})
  file(RELATIVE_PATH path ${PROJECT_SOURCE_DIR}/src ${source})
  string(REPLACE "." "_" symbol ${variant}${stage})
  set_property(GLOBAL APPEND_STRING PROPERTY estampe_shader_variants "    {\"${symbol}\", \"${path}\", \"${macros}\"},\n")
endfunction()

# estampe_shader_variant_table(program) gives the target estampe_program a header "shaders/variant_table.hpp" of all
# variants that were declared before, for what compiles shaders while the program runs.
function(estampe_shader_variant_table name)
  get_property(variants GLOBAL PROPERTY estampe_shader_variants)
  configure_file(${PROJECT_SOURCE_DIR}/cmake/shader_variant_table.hpp.in
    ${CMAKE_CURRENT_BINARY_DIR}/shaders/variant_table.hpp @ONLY)
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
