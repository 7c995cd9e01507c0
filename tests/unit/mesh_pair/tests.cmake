# SPDX-License-Identifier: MIT
elbowroom_tests(test_mesh_pair unit/mesh_pair LABEL fast LINK elbowroom_collision)
