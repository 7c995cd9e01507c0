# SPDX-License-Identifier: MIT
find_package(hwy REQUIRED)
elbowroom_tests(test_mesh_pair unit/mesh_pair LABEL fast LINK elbowroom_collision hwy::hwy)
