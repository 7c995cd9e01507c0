# SPDX-License-Identifier: MIT
elbowroom_tests(test_planning_properties property/planning LABEL fast LINK elbowroom_planning)
