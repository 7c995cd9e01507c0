# SPDX-License-Identifier: MIT
# The truth test: problems without end on real figures, every delivered file judged, and the
# peer's beside it.
# In the environment: ELBOWROOM_TRUTH_PROBLEMS, how many (2000 if not set); ELBOWROOM_TRUTH_FROM, the
# first one's number; ELBOWROOM_TRUTH_KEEP, a folder for the files of those that go wrong;
# ELBOWROOM_TRUTH_PROGRAM, another build of the program.
if(TARGET elbowroom)
  elbowroom_tests(test_truth truth LABEL long TIMEOUT 36000
    LINK elbowroom_judge elbowroom_io elbowroom_anatomy nlohmann_json::nlohmann_json)
  target_compile_definitions(test_truth PRIVATE
    ELBOWROOM_PROGRAM="$<TARGET_FILE:elbowroom>" ELBOWROOM_DEMO_DIR="${CMAKE_BINARY_DIR}/assets")
  add_dependencies(test_truth elbowroom elbowroom_demo_files)
  if(TARGET elbowroom_peer)
    target_link_libraries(test_truth PRIVATE elbowroom_peer elbowroom_editing)
    target_compile_definitions(test_truth PRIVATE ELBOWROOM_PEER)
  endif()
endif()
