# SPDX-License-Identifier: MIT
# elbowroom_bench: our planner beside OMPL's RRTConnect on FCL, on the same problems in one run.
if(TARGET elbowroom_peer)
  file(GLOB bench_sources CONFIGURE_DEPENDS ${CMAKE_CURRENT_LIST_DIR}/*.cpp)
  add_executable(elbowroom_bench ${bench_sources})
  elbowroom_not_in_all(elbowroom_bench elbowroom_benchmarks)
  target_link_libraries(elbowroom_bench PRIVATE elbowroom_editing elbowroom_io elbowroom_test_support
                        elbowroom_peer)
  target_compile_definitions(elbowroom_bench PRIVATE
    ELBOWROOM_DEMO_DIR="${CMAKE_BINARY_DIR}/assets")
  add_dependencies(elbowroom_bench elbowroom_demo_files)
endif()
