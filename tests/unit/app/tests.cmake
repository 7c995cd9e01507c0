# SPDX-License-Identifier: MIT
elbowroom_tests(test_app unit/app LABEL fast LINK elbowroom_app)
