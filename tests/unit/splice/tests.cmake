# SPDX-License-Identifier: MIT
elbowroom_tests(test_splice unit/splice LABEL fast LINK elbowroom_animation)
