# SPDX-License-Identifier: MIT
# elbowroom_peer: OMPL's RRTConnect on FCL, for the benchmark and the truth test.
if(ELBOWROOM_BENCH)
  # OMPL's .pc file names Boost libraries that its package does not bring; its headers want none.
  find_path(OMPL_INCLUDE_DIR ompl/config.h PATH_SUFFIXES ompl-1.5 ompl-1.6 REQUIRED)
  find_library(OMPL_LIBRARY ompl REQUIRED)
  find_path(FCL_INCLUDE_DIR fcl/fcl.h REQUIRED)
  find_library(FCL_LIBRARY fcl REQUIRED)
  find_library(CCD_LIBRARY ccd REQUIRED)
  find_package(Eigen3 REQUIRED)

  file(GLOB peer_sources CONFIGURE_DEPENDS ${CMAKE_CURRENT_LIST_DIR}/*.cpp)
  add_library(elbowroom_peer STATIC EXCLUDE_FROM_ALL ${peer_sources})
  target_link_libraries(elbowroom_peer PUBLIC elbowroom_collision elbowroom_planning
                        PRIVATE Eigen3::Eigen ${OMPL_LIBRARY} ${FCL_LIBRARY} ${CCD_LIBRARY})
  target_include_directories(elbowroom_peer SYSTEM PRIVATE ${OMPL_INCLUDE_DIR} ${FCL_INCLUDE_DIR})
  # GCC 12 sees an uninitialized value inside FCL's inlined headers.
  set_source_files_properties(${CMAKE_CURRENT_LIST_DIR}/fcl_world.cpp PROPERTIES
    COMPILE_OPTIONS -Wno-maybe-uninitialized)
endif()
