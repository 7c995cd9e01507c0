# SPDX-License-Identifier: MIT
elbowroom_tests(test_fuzz_io_read fuzz/io_read LABEL long TIMEOUT 3600 LINK elbowroom_io)
target_sources(test_fuzz_io_read PRIVATE
  ${CMAKE_CURRENT_SOURCE_DIR}/unit/io_read/gltf_maker.cpp
  ${CMAKE_CURRENT_SOURCE_DIR}/unit/io_read/model_checks.cpp
  ${CMAKE_CURRENT_SOURCE_DIR}/unit/io_read/mutation.cpp
  ${CMAKE_CURRENT_SOURCE_DIR}/unit/io_read/sample_index.cpp)
