# SPDX-License-Identifier: MIT
elbowroom_tests(test_layers unit/layers LABEL fast)
if(TARGET test_layers)
  target_compile_definitions(test_layers PRIVATE ELBOWROOM_SOURCE_DIR="${CMAKE_SOURCE_DIR}")
endif()
