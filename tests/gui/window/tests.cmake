# SPDX-License-Identifier: MIT
# The real program in a real window, driven by mouse and keys under Xvfb. Pictures of what it showed
# are kept in gui_pictures/ of the build folder.
if(TARGET elbowroom)
  foreach(label fast long)
    if(label STREQUAL fast)
      set(name test_window)
      set(folder gui/window)
      set(limit 240)
      set(beside IN_TURN)  # the driver waits for what it looks for
    else()
      set(beside SERIAL)  # among them, what a hand feels of the editor's speed
      set(name test_window_long)
      set(folder gui/window/long)
      set(limit 3600)  # a hundred and seventy broken files, one after the other
    endif()
    elbowroom_tests(${name} ${folder} LABEL ${label} TIMEOUT ${limit} ${beside} TOGETHER
      LINK elbowroom_judge elbowroom_io elbowroom_anatomy elbowroom_app glfw
           nlohmann_json::nlohmann_json)
    if(TARGET ${name})
      target_sources(${name} PRIVATE ${CMAKE_CURRENT_LIST_DIR}/driver/driven_editor.cpp
                                     ${CMAKE_CURRENT_LIST_DIR}/driver/screen.cpp)
      target_compile_definitions(${name} PRIVATE
        ELBOWROOM_PROGRAM="$<TARGET_FILE:elbowroom>" ELBOWROOM_DEMO_DIR="${CMAKE_BINARY_DIR}/assets"
        ELBOWROOM_PICTURES="${CMAKE_BINARY_DIR}/gui_pictures")
      add_dependencies(${name} elbowroom elbowroom_demo_files)
    endif()
  endforeach()
endif()
