# SPDX-License-Identifier: MIT
if(ELBOWROOM_BENCH)
  find_package(Eigen3 QUIET NO_MODULE)
  find_package(fcl QUIET)
  if(fcl_FOUND)
    add_executable(elbowroom_bench_mesh_pair ${CMAKE_CURRENT_SOURCE_DIR}/bench/mesh_pair_bench.cpp)
    elbowroom_not_in_all(elbowroom_bench_mesh_pair elbowroom_benchmarks)
    target_link_libraries(elbowroom_bench_mesh_pair PRIVATE elbowroom_test_support
                          elbowroom_collision fcl)
    # FCL's own headers, instantiated for float.
    target_compile_options(elbowroom_bench_mesh_pair PRIVATE -Wno-maybe-uninitialized)
  endif()
endif()
