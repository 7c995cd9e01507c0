# SPDX-License-Identifier: MIT
elbowroom_tests(test_scene_collision unit/scene_collision LABEL fast LINK elbowroom_collision)
