# SPDX-License-Identifier: MIT
elbowroom_tests(test_project unit/project LABEL fast LINK elbowroom_io)
