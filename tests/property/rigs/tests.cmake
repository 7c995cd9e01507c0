# SPDX-License-Identifier: MIT
# The table over all sample characters: one command says for each rig what was expected and found.
elbowroom_tests(test_rigs property/rigs LABEL fast
                LINK elbowroom_ik elbowroom_anatomy elbowroom_io TIMEOUT 200)
# What the planner makes of the same rig in another guise, over 100 seeds.
elbowroom_tests(test_rigs_long property/rigs/long LABEL long
                LINK elbowroom_editing elbowroom_io TIMEOUT 3600)
if(TARGET test_rigs_long)
  target_sources(test_rigs_long PRIVATE
    ${CMAKE_CURRENT_SOURCE_DIR}/property/rigs/changed_rigs.cpp)
endif()
