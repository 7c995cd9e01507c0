# SPDX-License-Identifier: MIT
elbowroom_tests(test_animation unit/animation LABEL fast LINK elbowroom_animation)
