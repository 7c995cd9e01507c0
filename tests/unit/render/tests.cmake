# SPDX-License-Identifier: MIT
elbowroom_tests(test_render unit/render LABEL fast TOGETHER
  LINK elbowroom_render elbowroom_io PkgConfig::EPOXY PkgConfig::STB TIMEOUT 120)
