# SPDX-License-Identifier: MIT
# The whole window without a window: panels, editor and its threads, driven by mouse and keyboard.
if(TARGET elbowroom_gui_driver)
  elbowroom_tests(test_panels gui/panels LABEL fast TOGETHER
    LINK elbowroom_gui_driver elbowroom_app elbowroom_demo TIMEOUT 120)
  if(TARGET test_panels)
    add_dependencies(test_panels elbowroom_demo_files)
    target_compile_definitions(test_panels PRIVATE
      ELBOWROOM_DEMO_DIR="${CMAKE_BINARY_DIR}/assets")
  endif()
endif()
