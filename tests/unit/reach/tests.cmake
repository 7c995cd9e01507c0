# SPDX-License-Identifier: MIT
if(TARGET elbowroom_demo_files)
  elbowroom_tests(test_reach unit/reach LABEL fast LINK elbowroom_editing TIMEOUT 200)
  add_dependencies(test_reach elbowroom_demo_files)
  target_compile_definitions(test_reach PRIVATE ELBOWROOM_DEMO_DIR="${CMAKE_BINARY_DIR}/assets")
endif()
