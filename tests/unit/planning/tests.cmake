# SPDX-License-Identifier: MIT
elbowroom_tests(test_planning unit/planning LABEL fast LINK elbowroom_planning)
