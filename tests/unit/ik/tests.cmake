# SPDX-License-Identifier: MIT
elbowroom_tests(test_ik unit/ik LABEL fast LINK elbowroom_ik TIMEOUT 60)
