# SPDX-License-Identifier: MIT
# elbowroom_bench_render: milliseconds a picture of the demo, by quality and by what changed.
if(ELBOWROOM_BENCH AND TARGET elbowroom_demo_files)
  add_executable(elbowroom_bench_render ${CMAKE_CURRENT_SOURCE_DIR}/bench/render/main.cpp)
  elbowroom_not_in_all(elbowroom_bench_render elbowroom_benchmarks)
  target_link_libraries(elbowroom_bench_render PRIVATE elbowroom_render elbowroom_collision
                        elbowroom_io elbowroom_demo PkgConfig::EPOXY PkgConfig::STB)
  add_dependencies(elbowroom_bench_render elbowroom_demo_files)
  target_compile_definitions(elbowroom_bench_render PRIVATE
    ELBOWROOM_DEMO_DIR="${CMAKE_BINARY_DIR}/assets")
endif()
