# SPDX-License-Identifier: MIT
# 100,000 targets for each rig.
elbowroom_tests(test_ik_on_samples_long property/ik/long LABEL long
                LINK elbowroom_ik elbowroom_io TIMEOUT 7200)
if(TARGET test_ik_on_samples_long)
  target_sources(test_ik_on_samples_long PRIVATE ${CMAKE_SOURCE_DIR}/tests/property/ik/targets.cpp)
endif()
