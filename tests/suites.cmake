# Read by ctest: a test for each suite of `program`, which is asked what it holds; `floor` names it, `environment` is that of the tests.
# A suite is one process: what its tests share is made once, and a program that loads many libraries starts 500 times, not 3000.
execute_process(COMMAND ${emulator} ${program} --gtest_list_tests OUTPUT_VARIABLE listed RESULT_VARIABLE result ERROR_VARIABLE error)
if(NOT result EQUAL 0)
  message(WARNING "${program} --gtest_list_tests: ${result} ${error}")
  add_test("${floor}_NOT_BUILT" "${floor}_NOT_BUILT")  # which fails
  return()
endif()
string(REGEX MATCHALL "(^|\n)[A-Za-z0-9_/]+\\." suites "${listed}")
if(NOT suites)
  add_test("${floor}_HAS_NO_SUITE" "${floor}_HAS_NO_SUITE")  # which fails
endif()
foreach(suite IN LISTS suites)
  string(REGEX REPLACE "^\n?(.*)\\.$" "\\1" suite "${suite}")
  add_test("${floor}.${suite}" ${emulator} "${program}" "--gtest_filter=${suite}.*")
  set_tests_properties("${floor}.${suite}" PROPERTIES TIMEOUT 3000 WORKING_DIRECTORY "${folder}" ENVIRONMENT "${environment}")
endforeach()
