# SPDX-License-Identifier: MIT
# elbowroom_peer: OMPL's RRTConnect on FCL, for the benchmark and the truth test.
if(ELBOWROOM_BENCH AND TARGET elbowroom_fcl_world)
  # OMPL's .pc file names Boost libraries that its package does not bring; its headers want none.
  find_path(OMPL_INCLUDE_DIR ompl/config.h PATH_SUFFIXES ompl-1.5 ompl-1.6 REQUIRED)
  find_library(OMPL_LIBRARY ompl REQUIRED)
  find_package(Eigen3 REQUIRED)

  file(GLOB peer_sources CONFIGURE_DEPENDS ${CMAKE_CURRENT_LIST_DIR}/*.cpp)
  add_library(elbowroom_peer STATIC EXCLUDE_FROM_ALL ${peer_sources})
  target_link_libraries(elbowroom_peer PUBLIC elbowroom_fcl_world elbowroom_planning
                        PRIVATE Eigen3::Eigen ${OMPL_LIBRARY})
  target_include_directories(elbowroom_peer SYSTEM PRIVATE ${OMPL_INCLUDE_DIR})
endif()
