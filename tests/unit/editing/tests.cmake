# SPDX-License-Identifier: MIT
elbowroom_tests(test_editing unit/editing LABEL fast LINK elbowroom_editing elbowroom_demo)
if(TARGET test_editing)
  add_dependencies(test_editing elbowroom_demo_files)
  target_compile_definitions(test_editing PRIVATE
    ELBOWROOM_DEMO_DIR="${CMAKE_BINARY_DIR}/assets")
endif()
