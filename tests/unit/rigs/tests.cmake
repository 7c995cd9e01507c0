# SPDX-License-Identifier: MIT
# Limbs of skeletons made after the habits of the usual rigging tools, with and without names.
elbowroom_tests(test_rig_habits unit/rigs LABEL fast TOGETHER LINK elbowroom_anatomy)
