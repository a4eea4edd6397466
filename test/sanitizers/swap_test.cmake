# Read by ctest after the tests' names.
set_tests_properties(SwapTest.TheSameProgramRunsWithBothClasses
  PROPERTIES ENVIRONMENT "ASAN_OPTIONS=alloc_dealloc_mismatch=0")
