# SPDX-License-Identifier: MIT
elbowroom_tests(test_anatomy unit/anatomy LABEL fast TOGETHER LINK elbowroom_anatomy)
