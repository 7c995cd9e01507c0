# SPDX-License-Identifier: MIT
# Judges that share no code with core/collision: CGAL's exact predicates, and FCL. The same placements
# run as 10,000 in the fast tier and 100,000 in the long one.
find_package(Eigen3 QUIET NO_MODULE)  # which FCL needs and does not ask for
find_package(fcl QUIET)
find_package(CGAL QUIET)
if(fcl_FOUND AND CGAL_FOUND)
  file(GLOB mesh_pair_oracle CONFIGURE_DEPENDS ${CMAKE_CURRENT_SOURCE_DIR}/oracle/mesh_pair/*.cpp)
  foreach(tier fast long)
    set(program test_mesh_pair_oracle_${tier})
    add_executable(${program} ${mesh_pair_oracle})
    target_link_libraries(${program} PRIVATE elbowroom_test_support GTest::gtest_main
                          elbowroom_collision elbowroom_io fcl CGAL::CGAL)
    if(tier STREQUAL "long")
      target_compile_definitions(${program} PRIVATE ELBOWROOM_PLACEMENTS=100000)
      elbowroom_not_in_all(${program} elbowroom_long_tests)
    else()
      target_compile_definitions(${program} PRIVATE ELBOWROOM_PLACEMENTS=10000)
    endif()
    gtest_discover_tests(${program} DISCOVERY_TIMEOUT 60 TEST_SUFFIX .${tier}
      PROPERTIES LABELS ${tier} TIMEOUT 3000)
  endforeach()
else()
  message(WARNING "FCL or CGAL not found (libfcl-dev, libcgal-dev): mesh pairs go without a judge")
endif()
