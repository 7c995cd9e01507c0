# SPDX-License-Identifier: MIT
# elbowroom_bench: our planner beside OMPL's RRTConnect on FCL, on the same problems in one run.
if(ELBOWROOM_BENCH)
  # OMPL's .pc file names Boost libraries that its package does not bring; its headers want none.
  find_path(OMPL_INCLUDE_DIR ompl/config.h PATH_SUFFIXES ompl-1.5 ompl-1.6 REQUIRED)
  find_library(OMPL_LIBRARY ompl REQUIRED)
  find_path(FCL_INCLUDE_DIR fcl/fcl.h REQUIRED)
  find_library(FCL_LIBRARY fcl REQUIRED)
  find_library(CCD_LIBRARY ccd REQUIRED)
  find_package(Eigen3 REQUIRED)

  file(GLOB bench_sources CONFIGURE_DEPENDS ${CMAKE_CURRENT_LIST_DIR}/*.cpp)
  add_executable(elbowroom_bench ${bench_sources})
  elbowroom_not_in_all(elbowroom_bench elbowroom_benchmarks)
  target_link_libraries(elbowroom_bench PRIVATE elbowroom_editing elbowroom_io elbowroom_test_support
                        Eigen3::Eigen ${OMPL_LIBRARY} ${FCL_LIBRARY} ${CCD_LIBRARY})
  target_include_directories(elbowroom_bench SYSTEM PRIVATE ${OMPL_INCLUDE_DIR} ${FCL_INCLUDE_DIR})
  target_compile_definitions(elbowroom_bench PRIVATE
    ELBOWROOM_DEMO_DIR="${CMAKE_BINARY_DIR}/assets")
  # GCC 12 sees an uninitialized value inside FCL's inlined headers.
  set_source_files_properties(${CMAKE_CURRENT_LIST_DIR}/fcl_world.cpp PROPERTIES
    COMPILE_OPTIONS -Wno-maybe-uninitialized)
  add_dependencies(elbowroom_bench elbowroom_demo_files)
endif()
