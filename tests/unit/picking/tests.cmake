# SPDX-License-Identifier: MIT
if(TARGET elbowroom_demo_files)
  elbowroom_tests(test_picking unit/picking LABEL fast
    LINK elbowroom_collision elbowroom_io elbowroom_demo TIMEOUT 120)
  add_dependencies(test_picking elbowroom_demo_files)
  target_compile_definitions(test_picking PRIVATE
    ELBOWROOM_DEMO_DIR="${CMAKE_BINARY_DIR}/assets")
endif()
