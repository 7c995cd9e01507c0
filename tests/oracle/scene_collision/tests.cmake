# SPDX-License-Identifier: MIT
# Contacts on the deformed skin against the judge's: own reader, skinning, FCL and CGAL.
elbowroom_tests(test_scene_collision_oracle oracle/scene_collision LABEL fast
  LINK elbowroom_collision elbowroom_io elbowroom_judge TIMEOUT 600)
