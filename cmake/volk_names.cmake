# Writes gpu/volk_names.hpp, which gives volk's symbols names of Estampe's own. volk calls its function pointers what the
# Vulkan loader calls its functions: an application that links the loader, or volk, beside Estampe would otherwise have two
# things of one name, and call a pointer as if it were code.

find_path(VOLK_INCLUDE_DIR volk.h REQUIRED)
file(STRINGS ${VOLK_INCLUDE_DIR}/volk.h volk_lines REGEX "^extern PFN_vk|^[A-Za-z0-9]+ volk[A-Za-z]+\\(")
set(volk_names "")
foreach(line ${volk_lines})
  string(REGEX REPLACE "^[^ ]+ (PFN_vk[A-Za-z0-9]+ )?([A-Za-z0-9]+).*" "\\2" name ${line})
  string(APPEND volk_names "#pragma redefine_extname ${name} estampe_${name}\n")
endforeach()
file(CONFIGURE OUTPUT ${PROJECT_BINARY_DIR}/generated/gpu/volk_names.hpp @ONLY CONTENT
"// Made from volk.h by cmake/volk_names.cmake.
#pragma once

@volk_names@")
