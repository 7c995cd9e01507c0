# SPDX-License-Identifier: MIT
elbowroom_tests(test_scene unit/scene LABEL fast LINK elbowroom_scene)
