# SPDX-License-Identifier: MIT
if(TARGET elbowroom_demo_files)
  elbowroom_tests(test_assets unit/assets LABEL fast LINK elbowroom_demo elbowroom_io)
  add_dependencies(test_assets elbowroom_demo_files)
  target_compile_definitions(test_assets PRIVATE
    ELBOWROOM_DEMO_DIR="${CMAKE_BINARY_DIR}/assets")
endif()
