# One test of CTest for each suite of GoogleTest, in one process: a device, its pipelines and scenes are made once a
# suite, where gtest_discover_tests would make them for each test.
#
# estampe_test_suites(TARGET LABEL name TIMEOUT seconds). Suites are listed whenever the target has been linked, and
# labelled `quick` too as tests/quick_suites.txt says.
function(estampe_test_suites target)
  cmake_parse_arguments(PARSE_ARGV 1 suites "" "LABEL;TIMEOUT" "")
  set(list ${CMAKE_CURRENT_BINARY_DIR}/${target}_suites.cmake)
  add_custom_command(TARGET ${target} POST_BUILD VERBATIM
    COMMAND ${CMAKE_COMMAND} -D program=$<TARGET_FILE:${target}> -D list=${list} -D label=${suites_LABEL}
            -D timeout=${suites_TIMEOUT} -D quick_suites=${PROJECT_SOURCE_DIR}/tests/quick_suites.txt
            -P ${PROJECT_SOURCE_DIR}/cmake/list_test_suites.cmake)
  set_property(TARGET ${target} APPEND PROPERTY LINK_DEPENDS ${PROJECT_SOURCE_DIR}/tests/quick_suites.txt)
  if(NOT EXISTS ${list})
    file(WRITE ${list} "add_test(${target}_NOT_BUILT ${target}_NOT_BUILT)\n")
  endif()
  set_property(DIRECTORY APPEND PROPERTY TEST_INCLUDE_FILES ${list})
endfunction()
