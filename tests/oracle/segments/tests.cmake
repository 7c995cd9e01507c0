# SPDX-License-Identifier: MIT
# Certified edges against FCL at a hundredth of the usual step: 600 in the fast tier, 100,000 in the
# long one.
find_package(Eigen3 QUIET NO_MODULE)  # which FCL needs and does not ask for
find_package(fcl QUIET)
if(fcl_FOUND)
  # Once for both, since FCL's headers take a minute.
  add_library(elbowroom_segments_judge STATIC EXCLUDE_FROM_ALL oracle/segments/fcl_world.cpp)
  target_link_libraries(elbowroom_segments_judge PUBLIC elbowroom_collision fcl)
  # GCC 12 sees an uninitialized value inside FCL's inlined headers.
  target_compile_options(elbowroom_segments_judge PRIVATE -Wno-maybe-uninitialized)
  foreach(tier fast long)
    set(program test_segments_${tier})
    add_executable(${program} oracle/segments/segments_test.cpp
                   unit/scene_collision/figure.cpp)
    target_link_libraries(${program} PRIVATE elbowroom_test_support GTest::gtest_main
                          elbowroom_segments_judge)
    if(tier STREQUAL "long")
      target_compile_definitions(${program} PRIVATE ELBOWROOM_SEGMENTS=100000)
      elbowroom_not_in_all(${program} elbowroom_long_tests)
    else()
      target_compile_definitions(${program} PRIVATE ELBOWROOM_SEGMENTS=600)
    endif()
    gtest_discover_tests(${program} DISCOVERY_TIMEOUT 60 TEST_SUFFIX .${tier}
      PROPERTIES LABELS ${tier} TIMEOUT 6000)
  endforeach()
endif()
