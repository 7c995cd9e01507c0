# SPDX-License-Identifier: MIT
elbowroom_tests(test_io_write unit/io_write LABEL fast TOGETHER LINK elbowroom_io elbowroom_judge)
target_compile_definitions(test_io_write PRIVATE ELBOWROOM_SOURCE_DIR="${CMAKE_SOURCE_DIR}")
