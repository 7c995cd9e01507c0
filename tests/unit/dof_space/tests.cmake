# SPDX-License-Identifier: MIT
elbowroom_tests(test_dof_space unit/dof_space LABEL fast LINK elbowroom_base)
