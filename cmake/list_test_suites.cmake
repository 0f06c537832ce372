# cmake -D program=... -D list=FILE -D label=... -D timeout=... -P list_test_suites.cmake
execute_process(COMMAND ${program} --gtest_list_tests OUTPUT_VARIABLE output COMMAND_ERROR_IS_FATAL ANY)
string(REGEX MATCHALL "[^\n]+" lines "${output}")
set(tests "")
foreach(line IN LISTS lines)
  if(line MATCHES "^([A-Za-z0-9_/]+)\\.( |$)")
    set(suite ${CMAKE_MATCH_1})
    string(REPLACE "/" "_" name ${suite})
    string(APPEND tests "add_test([=[${name}]=] [=[${program}]=] [=[--gtest_filter=${suite}.*]=])\n"
                        "set_tests_properties([=[${name}]=] PROPERTIES LABELS ${label} TIMEOUT ${timeout})\n")
  endif()
endforeach()
file(WRITE ${list} "${tests}")
