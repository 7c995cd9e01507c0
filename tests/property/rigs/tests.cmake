# SPDX-License-Identifier: MIT
# The table over all sample characters: one command says for each rig what was expected and found.
elbowroom_tests(test_rigs property/rigs LABEL fast
                LINK elbowroom_ik elbowroom_anatomy elbowroom_io TIMEOUT 200)
