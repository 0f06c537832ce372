# Makes a header of a shader's text. Line marks go: they name files of the machine that built it.
file(READ ${FLAT} text)
string(REGEX REPLACE "#line [^\n]*\n" "" text "${text}")
file(WRITE ${HEADER} "#pragma once\n\nnamespace estampe::shaders {\n\ninline constexpr const char* ${SYMBOL} = R\"glsl(${text})glsl\";\n\n} // namespace estampe::shaders\n")
