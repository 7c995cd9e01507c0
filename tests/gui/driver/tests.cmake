# SPDX-License-Identifier: MIT
# Drives panels and widgets without a window; its own library, because it needs Dear ImGui.
if(TARGET elbowroom_toolkit)
  file(GLOB gui_driver_sources CONFIGURE_DEPENDS ${CMAKE_CURRENT_SOURCE_DIR}/gui/driver/*.cpp)
  add_library(elbowroom_gui_driver STATIC ${gui_driver_sources})
  target_link_libraries(elbowroom_gui_driver
    PUBLIC elbowroom_toolkit elbowroom_render GTest::gtest PkgConfig::EPOXY)
endif()
