# SPDX-License-Identifier: MIT
elbowroom_tests(test_gizmo unit/gizmo LABEL fast LINK elbowroom_render TIMEOUT 60)
