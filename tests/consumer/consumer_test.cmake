# What is installed can be found, compiled against and run by a project that knows nothing of this tree.
set(prefix ${CMAKE_CURRENT_BINARY_DIR}/consumer/prefix)
add_test(NAME Consumer.Installs
  COMMAND ${CMAKE_COMMAND} --install ${PROJECT_BINARY_DIR} --prefix ${prefix})
set_tests_properties(Consumer.Installs PROPERTIES FIXTURES_SETUP installation LABELS consumer TIMEOUT 60)

string(TOUPPER "${CMAKE_BUILD_TYPE}" config)
add_test(NAME Consumer.FindsBuildsAndRuns
  COMMAND ${CMAKE_CTEST_COMMAND}
    --build-and-test ${CMAKE_CURRENT_SOURCE_DIR}/consumer ${CMAKE_CURRENT_BINARY_DIR}/consumer/build
    --build-generator ${CMAKE_GENERATOR}
    --build-options -DCMAKE_PREFIX_PATH=${prefix} -DCMAKE_CXX_COMPILER=${CMAKE_CXX_COMPILER}
      -DCMAKE_BUILD_TYPE=${CMAKE_BUILD_TYPE} -DCMAKE_CXX_FLAGS_${config}=${CMAKE_CXX_FLAGS_${config}}
    --test-command consumer)
set_tests_properties(Consumer.FindsBuildsAndRuns PROPERTIES
  FIXTURES_REQUIRED installation LABELS consumer TIMEOUT 300)
