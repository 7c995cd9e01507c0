# SPDX-License-Identifier: MIT
# Certified edges against FCL at a hundredth of the usual step: 600 in the fast tier, 100,000 in the
# long one.
if(TARGET elbowroom_fcl_world)
  foreach(tier fast long)
    set(program test_segments_${tier})
    add_executable(${program} oracle/segments/segments_test.cpp
                   unit/scene_collision/figure.cpp)
    target_link_libraries(${program} PRIVATE elbowroom_test_support GTest::gtest_main
                          elbowroom_fcl_world)
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
