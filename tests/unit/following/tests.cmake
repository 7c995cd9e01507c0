# SPDX-License-Identifier: MIT
# Joints that belong to a limb but hang from elsewhere in the tree.
elbowroom_tests(test_following unit/following LABEL fast TOGETHER LINK elbowroom_editing)
